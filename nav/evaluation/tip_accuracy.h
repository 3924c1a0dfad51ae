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

/// A figure up to `pass_m` passes, one up to `note_m` is noted, a larger one fails.
struct AccuracyLimits {
  double pass_m;
  double note_m;
};

/// The default limits suit pedicle screws, where breaching the wall by 2 mm separates acceptable
/// from not (Gertzbein and Robbins 1990): to pass or be noted, every part must stay within that on
/// its own, and the largest point-to-point error within twice that.
struct AccuracyOptions {
  AccuracyLimits single_point_p95{0.001, 0.002};
  AccuracyLimits turning_p95{0.002, 0.004};
  AccuracyLimits tip_bias{0.001, 0.002};
  AccuracyLimits distance_mean{0.0005, 0.001};
  AccuracyLimits distance_max{0.002, 0.004};

  /// Everything wrong with the numbers, one line each: name, value, limit. Empty: fine.
  [[nodiscard]] std::vector<std::string> check() const;
};

/// A figure and its limits.
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
  /// Why the part fails regardless of its figures, such as a tip that slipped; empty if there is no
  /// such reason.
  std::string failure;
  [[nodiscard]] Verdict verdict() const;
};

/// Single-point repeatability: the tip rests in the dimple, the pointer is held still.
struct SinglePointPart : AccuracyPart {
  TipSpread spread;
  std::optional<double> predicted_rms_m;  ///< from the poses' covariance, where there is one
};

/// Tips at one tilt of the pointer from its mean direction.
struct TiltBin {
  double from_rad = 0.0;
  double to_rad = 0.0;
  std::size_t samples = 0;
  double rms_m = 0.0;  ///< about the mean of all tips
  double max_m = 0.0;
};

/// Sensitivity to orientation: the pointer turns about its resting tip.
struct TurningPart : AccuracyPart {
  TipSpread spread;  ///< of the tips according to the tool file
  double largest_tilt_rad = 0.0;
  std::vector<TiltBin> bins;
  /// The systematic part: the tip that the tool turned about, minus the tip in the tool file.
  Vec3 tip_bias_m{};              ///< in the marker's axes
  double tip_bias_sigma_m = 0.0;  ///< predicted 3-D SD of it
  double residual_rms_m = 0.0;    ///< what remains of the spread without the bias
};

struct TouchedPoint {
  double time_s = 0.0;  ///< middle of the touch
  std::size_t samples = 0;
  Vec3 known_m{};     ///< on the board
  Vec3 residual_m{};  ///< touched minus known, along the board's axes, after the best rigid fit
};

/// Point-to-point distances of a board with known points.
struct DistancePart : AccuracyPart {
  std::vector<TouchedPoint> points;
  std::size_t stray_rests = 0;
  std::size_t distances = 0;
  double mean_error_m = 0.0;  ///< measured minus known
  double sd_m = 0.0;
  double rms_m = 0.0;
  double max_error_m = 0.0;  ///< largest in magnitude
  double fit_rmse_m = 0.0;
};

struct AccuracyReport {
  std::size_t samples = 0;
  double duration_s = 0.0;
  SinglePointPart single_point;
  TurningPart turning;
  std::optional<DistancePart> distances;
  [[nodiscard]] Verdict verdict() const;  ///< the worst of all parts
};

/// The three tests of ASTM F2554 for the accuracy of a tracked pointer, as far as a dimple and a
/// printed board allow. The dimple is the point about which the pointer turned longest (the tip is
/// fitted too, so that a wrong tip does not hide it). Single-point repeatability comes from the
/// longest stretch there without turning. The rests elsewhere are the touches of the board, in the
/// order of `board_points_m` (at least three; if empty, that test is skipped). Only measured poses
/// count. Refuses, in one line with value and limit, bad options, times that do not increase, and
/// too little data for a part.
Result<AccuracyReport> test_tip_accuracy(std::span<const TrackedPose> world_from_marker,
                                         const ToolGeometry& pointer,
                                         std::span<const Vec3> board_points_m,
                                         const AccuracyOptions& options = {});

}  // namespace orthonav::nav
