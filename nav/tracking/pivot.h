#pragma once

#include <cstddef>
#include <span>

#include "hal/api/result.h"
#include "hal/api/transform.h"

namespace orthonav::nav {

struct PivotOptions {
  std::size_t min_poses = 20;
  /// Least `spread_rad`: a cone of 12° half angle has 0.15.
  double min_spread_rad = 0.15;
  /// A larger residual means that the tip slipped.
  double max_rmse_m = 0.002;
};

/// The tip of a tool that was turned about it.
struct PivotCalibration {
  Point<Marker> tip_in_marker;
  Point<World> pivot_in_world;
  double rmse_m = 0.0;  ///< of the tips about the pivot, 3-D
  /// RMS of the turning that fixes the tip where it is known worst; turning about one axis only
  /// gives 0, since the tip may then lie anywhere along it.
  double spread_rad = 0.0;
  double tip_sigma_m = 0.0;  ///< predicted 3-D SD of the tip from residual and geometry
};

/// Algebraic least squares over R·tip + t = pivot (Yaniv 2015, "Which pivot calibration?", the
/// algebraic one-step method). Refuses too few poses, numbers that are not finite, too little
/// turning and too large a residual, each with value and limit.
Result<PivotCalibration> pivot_calibration(std::span<const Transform<World, Marker>> poses,
                                           const PivotOptions& options = {});

}  // namespace orthonav::nav
