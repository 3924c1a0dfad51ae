#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "base/transform.h"

namespace orthonav::nav {

/// The algebraic one-step solution of R·tip + t = pivot over some poses (Yaniv 2015, "Which pivot
/// calibration?").
struct PivotFit {
  Point<Marker> tip_in_marker;
  Point<World> pivot_in_world;
  /// RMS of the rotation in the direction that determines the tip worst; 0 when it may lie anywhere
  /// along a line.
  double spread_rad = 0.0;
  double rmse_m = 0.0;  ///< of the tips about the pivot, 3-D

  /// How far a pose's tip lies from the pivot.
  [[nodiscard]] double miss_m(const Transform<World, Marker>& pose) const {
    return (pose * tip_in_marker - pivot_in_world).norm();
  }
};

/// Fits the poses with these indices, at least three; nothing if the tip is not determined.
[[nodiscard]] std::optional<PivotFit> fit_pivot(std::span<const Transform<World, Marker>> poses,
                                                std::span<const std::size_t> chosen);

}  // namespace orthonav::nav
