#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "base/transform.h"
#include "nav/statistics/verdict.h"

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

/// How well the tip of a pivot fit is known.
struct TipUncertainty {
  Mat3 covariance_m2{};  ///< of the tip, in the marker's axes
  /// So many uncorrelated poses would locate the pivot as well.
  double independent_poses = 0.0;

  [[nodiscard]] double sigma_m() const;  ///< 3-D SD
};

/// The covariance of the least-squares tip from residuals that are correlated over time: the tip
/// wanders in its seat, and the tracker's error changes only as the tool turns. They are taken for
/// a first-order autoregressive process plus white noise, the same in each direction. Correlation
/// time and share of white noise are those of greatest restricted likelihood (Patterson & Thompson
/// 1971), at most an eighth of the poses: a longer time cannot be told from so many. The poses with
/// the indices `chosen`, rising, are those of `fit`. A shift of the seat that follows the tool's
/// lean is a different tip and cannot be seen.
[[nodiscard]] TipUncertainty tip_uncertainty(std::span<const Transform<World, Marker>> poses,
                                             std::span<const std::size_t> chosen,
                                             const PivotFit& fit);

struct PivotOptions {
  std::size_t min_poses = 20;
  /// Least `spread_rad`: a cone of 12° half angle has 0.15.
  double min_spread_rad = 0.15;
  /// A larger residual means that the tip slipped.
  double max_rmse_m = 0.002;
  /// A pose whose tip misses the pivot by more is not an inlier. Three times the scatter of the
  /// published method 150 mm below a 40 mm tag; if the poses scatter less, the limit shrinks with
  /// them.
  double inlier_m = 0.005;
  /// With fewer inliers there is no single pivot: the tip moved, or the tool was not pivoted.
  double min_inlier_fraction = 0.6;
  double max_tip_sigma_m = 0.001;
  int rounds = 500;  ///< random samples tried
  std::uint64_t seed = 1;

  /// Every problem at once.
  [[nodiscard]] std::vector<std::string> check() const;
};

/// The tip of a tool that was turned about it.
struct PivotCalibration {
  Point<Marker> tip_in_marker;
  Point<World> pivot_in_world;
  double rmse_m = 0.0;  ///< of the inliers' tips about the pivot, 3-D
  /// RMS of the rotation in the direction that determines the tip worst; turning about a single
  /// axis gives 0, since the tip may then lie anywhere along it.
  double spread_rad = 0.0;
  /// 3-D SD of the tip: the larger of `leave_out_m` and that of `tip_uncertainty`.
  double tip_sigma_m = 0.0;
  Mat3 tip_covariance_m2{};        ///< in the marker's axes, of that SD
  double independent_poses = 0.0;  ///< `TipUncertainty::independent_poses`
  /// Jackknife SD from leaving out each tenth of the inliers in turn: it shows drift, which the
  /// residual alone takes for noise.
  double leave_out_m = 0.0;
  std::size_t poses = 0;
  std::vector<bool> inlier;  ///< of each pose
  std::size_t inliers = 0;
  Judgement judgement;  ///< pass or note; what fails is refused
};

/// Algebraic least squares over R·tip + t = pivot (`fit_pivot`) on the inliers that a search with
/// random samples finds (RANSAC with truncated squares, Torr & Zisserman 2000), three poses per
/// sample. Poses must be in the order of time. The same poses and options give the same bits.
/// Refuses bad options, too few poses, numbers that are not finite, too little turning, too few
/// inliers, too large a residual or uncertainty, each with value and limit.
Result<PivotCalibration> pivot_calibration(std::span<const Transform<World, Marker>> poses,
                                           const PivotOptions& options = {});

}  // namespace orthonav::nav
