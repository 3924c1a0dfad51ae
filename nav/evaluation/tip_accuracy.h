#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "nav/evaluation/tip_rests.h"
#include "nav/evaluation/tip_spread.h"
#include "nav/statistics/verdict.h"
#include "nav/tracking/tool.h"
#include "nav/tracking/tool_tracker.h"

namespace orthonav::nav {

/// A figure up to `pass_m` passes, up to `note_m` it is worth a note, beyond it fails.
struct AccuracyLimits {
  double pass_m;
  double note_m;
};

/// The defaults of the limits go with pedicle screws, where a wall breached by 2 mm is the step
/// between acceptable and not (Gertzbein and Robbins 1990): every part alone must stay within that
/// to pass or be noted, point-to-point errors within twice that at their worst.
struct AccuracyOptions {
  TipRestOptions rests;
  /// A pointer turned by less is held still, in a stretch of at least so long and so many samples.
  double still_angle_rad = 0.087;
  double min_still_s = 2.0;
  std::size_t min_still_samples = 15;
  /// Turning about the tip: at least so long, and so far as `PivotOptions::min_spread_rad` means
  /// it.
  double min_turning_s = 3.0;
  double min_turning_spread_rad = 0.15;
  /// Tips that fit a fixed point worse rest in no dimple.
  double max_turning_rmse_m = 0.005;
  /// Farther from where the tool file says, the resting point is not this pointer's tip.
  double max_tip_bias_m = 0.03;
  /// Whatever rests nearer to the dimple is the dimple, or has slipped out of it.
  double dimple_m = 0.025;
  /// The mean tip moved by more between before and after some moment: it slipped.
  double max_slip_m = 0.0015;
  /// Rests away from the dimple that touch no point of the board, such as a tool laid aside.
  std::size_t max_stray_rests = 4;
  /// Touches that fit the board worse are not of this board, or in another order.
  double max_board_rmse_m = 0.01;

  AccuracyLimits single_point_p95{0.001, 0.002};
  AccuracyLimits turning_p95{0.002, 0.004};
  AccuracyLimits tip_bias{0.001, 0.002};
  AccuracyLimits distance_mean{0.0005, 0.001};
  AccuracyLimits distance_max{0.002, 0.004};

  /// Everything wrong with the numbers, a line each: name, value, limit. Empty: fine.
  [[nodiscard]] std::vector<std::string> check() const;
};

/// A figure against its limits.
struct Judged {
  std::string what;
  double value_m = 0.0;
  AccuracyLimits limits{};
  Verdict verdict = Verdict::kPass;
};

/// What the three parts have in common.
struct AccuracyPart {
  double start_s = 0.0;  ///< from the first measured pose
  double end_s = 0.0;
  std::vector<Judged> judged;
  /// Why the part fails whatever its figures are, such as a tip that slipped; empty: it does not.
  std::string failure;
  [[nodiscard]] Verdict verdict() const;
};

/// Single-point repeatability: the tip rests in the dimple, the pointer is held still.
struct SinglePointPart : AccuracyPart {
  TipSpread spread;
  std::optional<double> predicted_rms_m;  ///< from the poses' covariance, where there is one
};

/// Tips at one tilt of the pointer against its mean direction.
struct TiltBin {
  double from_rad = 0.0;
  double to_rad = 0.0;
  std::size_t samples = 0;
  double rms_m = 0.0;  ///< about the mean of all tips
  double max_m = 0.0;
};

/// Sensitivity to orientation: the pointer turns about its resting tip.
struct TurningPart : AccuracyPart {
  TipSpread spread;  ///< of the tips as the tool file has them
  double largest_tilt_rad = 0.0;
  std::vector<TiltBin> bins;
  /// The systematic part: where the tip turned about is, less where the tool file says it is.
  Vec3 tip_bias_m{};              ///< in the marker's axes
  double tip_bias_sigma_m = 0.0;  ///< predicted 3-D SD of it
  double residual_rms_m = 0.0;    ///< what is left of the spread without the bias
};

struct TouchedPoint {
  double time_s = 0.0;  ///< middle of the touch
  std::size_t samples = 0;
  Vec3 known_m{};     ///< on the board
  Vec3 residual_m{};  ///< touched less known, along the board's axes, after the best rigid fit
};

/// Point-to-point distances of a board with known points.
struct DistancePart : AccuracyPart {
  std::vector<TouchedPoint> points;
  std::size_t stray_rests = 0;
  std::size_t distances = 0;
  double mean_error_m = 0.0;  ///< measured less known
  double sd_m = 0.0;
  double rms_m = 0.0;
  double max_error_m = 0.0;  ///< largest by amount
  double fit_rmse_m = 0.0;
};

struct AccuracyReport {
  std::size_t samples = 0;
  double duration_s = 0.0;
  SinglePointPart single_point;
  TurningPart turning;
  std::optional<DistancePart> distances;
  [[nodiscard]] Verdict verdict() const;  ///< the worst part's
};

/// The three tests of ASTM F2554 for the accuracy of a tracked pointer, as far as a dimple and a
/// printed board go: the dimple is found as the point that the pointer turned about longest (fitted
/// with a free tip, so that a wrong tip does not hide it), single-point repeatability is taken from
/// the longest stretch there without turning, and the rests elsewhere are the touches of the board,
/// in the order of `board_points_m` (at least three; none: no such test). Only measured poses
/// count. Refuses, in one line with value and limit, options that do not hold, times that do not
/// increase, and data too few for a part.
Result<AccuracyReport> test_tip_accuracy(std::span<const TrackedPose> world_from_marker,
                                         const ToolGeometry& pointer,
                                         std::span<const Vec3> board_points_m,
                                         const AccuracyOptions& options = {});

}  // namespace orthonav::nav
