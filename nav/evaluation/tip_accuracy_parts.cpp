#include "nav/evaluation/tip_accuracy_parts.h"

#include <algorithm>
#include <cmath>
#include <Eigen/Core>
#include <numbers>

#include "base/angle.h"
#include "base/findings.h"
#include "nav/evaluation/board_touches.h"
#include "nav/evaluation/errors.h"
#include "nav/evaluation/fixed_point.h"
#include "nav/geometry/matrix_as.h"
#include "nav/tracking/pivot.h"

namespace orthonav::nav {
namespace {

constexpr double kBin_rad = 10.0 * std::numbers::pi / 180.0;
/// A pointer held still turns by less than this.
constexpr double kStill_rad = 0.087;
/// The largest number of rests away from the dimple that touch no point of the board, such as a
/// tool laid aside.
constexpr std::size_t kMaxStrayRests = 4;
/// Touches that fit the board worse than this belong to another board, or are in another order.
constexpr double kMaxBoardRmse_m = 0.01;

const Mat3& rotation_at(const PointerTrack& track, std::size_t i) {
  return track.world_from_marker[i].value.rotation();
}

double length_s(const PointerTrack& track, const std::vector<std::size_t>& samples) {
  if (samples.empty()) {
    return 0.0;
  }
  return track.tips[samples.back()].time_s - track.tips[samples.front()].time_s;
}

/// Variance of the tip, summed over the axes: a small rotation w (parent's axes) moves it by w × r.
double tip_variance_m2(const TrackedPose& pose, Point<Marker> tip) {
  const Vec3 r = pose.value.rotation() * tip.v;
  const auto moves = moves_as<Eigen::Matrix<double, 3, 6>>(r);
  const auto covariance = matrix_as<Eigen::Matrix<double, 6, 6>>(pose.covariance);
  return (moves * covariance * moves.transpose()).trace();
}

std::optional<double> predicted_rms_m(const PointerTrack& track, Point<Marker> tip,
                                      const std::vector<std::size_t>& samples) {
  double sum_m2 = 0.0;
  for (const std::size_t i : samples) {
    sum_m2 += tip_variance_m2(track.world_from_marker[i], tip);
  }
  if (!(sum_m2 > 0.0) || !std::isfinite(sum_m2)) {
    return std::nullopt;
  }
  return std::sqrt(sum_m2 / static_cast<double>(samples.size()));
}

/// Without the ends, during which the pointer was settling.
std::vector<std::size_t> without_ends(const PointerTrack& track,
                                      const std::vector<std::size_t>& samples, double ends_s) {
  std::vector<std::size_t> inner;
  for (const std::size_t i : samples) {
    if (track.tips[i].time_s >= track.tips[samples.front()].time_s + ends_s &&
        track.tips[i].time_s <= track.tips[samples.back()].time_s - ends_s) {
      inner.push_back(i);
    }
  }
  return inner;
}

/// Tilt of the tool's axis from its mean direction, for each sample.
std::vector<double> tilts_rad(const PointerTrack& track, Direction<Marker> axis,
                              const std::vector<std::size_t>& samples) {
  Vec3 mean{};
  for (const std::size_t i : samples) {
    mean += rotation_at(track, i) * axis.v;
  }
  std::vector<double> tilts;
  for (const std::size_t i : samples) {
    tilts.push_back(angle_between_rad(mean, rotation_at(track, i) * axis.v));
  }
  return tilts;
}

std::vector<TiltBin> bins_of(const std::vector<TipSample>& tips, Vec3 mean_m,
                             const std::vector<double>& tilts) {
  std::vector<TiltBin> bins;
  for (std::size_t i = 0; i < tips.size(); ++i) {
    const auto index = static_cast<std::size_t>(tilts[i] / kBin_rad);
    while (bins.size() <= index) {
      const auto n = static_cast<double>(bins.size());
      bins.push_back({n * kBin_rad, (n + 1.0) * kBin_rad});
    }
    const double off_m = (tips[i].tip_m - mean_m).norm();
    TiltBin& bin = bins[index];
    ++bin.samples;
    bin.rms_m += off_m * off_m;
    bin.max_m = std::max(bin.max_m, off_m);
  }
  for (TiltBin& bin : bins) {
    if (bin.samples > 0) {
      bin.rms_m = std::sqrt(bin.rms_m / static_cast<double>(bin.samples));
    }
  }
  return bins;
}

struct RestingTip {
  PivotFit fit;
  double sigma_m = 0.0;  ///< 3-D SD of the tip
};

/// The tool's resting point, from all samples that rested in the dimple.
Result<RestingTip> fit_in(const PointerTrack& track, const Dimple& dimple) {
  std::vector<Transform<World, Marker>> poses;
  for (const TrackedPose& pose : track.world_from_marker) {
    poses.push_back(pose.value);
  }
  const auto fit = fit_pivot(poses, dimple.samples);
  const double spread_rad = fit ? fit->spread_rad : 0.0;
  if (!fit || spread_rad < kLeastTurningSpread_rad) {
    return refused(
        "accuracy test: the pointer turned by %.1f° RMS about its resting tip, at "
        "least %.1f° is needed",
        degrees(spread_rad), degrees(kLeastTurningSpread_rad));
  }
  return RestingTip{*fit, tip_uncertainty(poses, dimple.samples, *fit).sigma_m()};
}

void add_distances(const std::vector<Vec3>& touched_m, std::span<const Vec3> known_m,
                   DistancePart& part) {
  std::vector<double> errors_m;
  double squares = 0.0;
  for (std::size_t i = 0; i < touched_m.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      errors_m.push_back((touched_m[i] - touched_m[k]).norm() - (known_m[i] - known_m[k]).norm());
      squares += errors_m.back() * errors_m.back();
    }
  }
  const Summary summary = summarize(errors_m);
  part.distances = summary.count;
  part.mean_error_m = summary.mean;
  part.sd_m = summary.sd;
  part.rms_m = std::sqrt(squares / static_cast<double>(summary.count));
  part.max_error_m = std::max(std::abs(summary.min), std::abs(summary.max));
}

}  // namespace

Judged judged(std::string what, double value_m, const AccuracyLimits& limits) {
  const Verdict verdict = value_m <= limits.pass_m   ? Verdict::kPass
                          : value_m <= limits.note_m ? Verdict::kNote
                                                     : Verdict::kFail;
  return {std::move(what), value_m, limits, verdict};
}

std::vector<TipSample> picked(const std::vector<TipSample>& from,
                              const std::vector<std::size_t>& indices) {
  std::vector<TipSample> out;
  for (const std::size_t i : indices) {
    out.push_back(from[i]);
  }
  return out;
}

Result<std::vector<std::size_t>> still_stretch(const PointerTrack& track, const Dimple& dimple) {
  std::vector<std::size_t> best;
  std::vector<std::size_t> stretch;
  for (const std::size_t i : dimple.samples) {
    const bool goes_on = stretch.empty() ||
                         track.tips[i].time_s - track.tips[stretch.back()].time_s <= kLongestGap_s;
    if (!goes_on) {
      stretch.clear();
    }
    stretch.push_back(i);
    // The oldest samples are dropped until the newest is within the angle of all remaining ones.
    std::size_t drop = 0;
    for (std::size_t k = 0; k + 1 < stretch.size(); ++k) {
      if (rotation_angle_rad(rotation_at(track, stretch[k]), rotation_at(track, i)) > kStill_rad) {
        drop = k + 1;
      }
    }
    stretch.erase(stretch.begin(), stretch.begin() + static_cast<std::ptrdiff_t>(drop));
    if (length_s(track, stretch) > length_s(track, best)) {
      best = stretch;
    }
  }
  const std::vector<std::size_t> inner = without_ends(track, best, kSettle_s);
  if (length_s(track, inner) < kLeastStill_s) {
    return refused(
        "accuracy test: the pointer was held still in the dimple for %.1f s, at least "
        "%.1f s are needed",
        length_s(track, inner), kLeastStill_s);
  }
  if (inner.size() < kLeastStillSamples) {
    return refused(
        "accuracy test: %.0f measured poses while the pointer was held still, at least "
        "%.0f are needed",
        static_cast<double>(inner.size()), static_cast<double>(kLeastStillSamples));
  }
  return inner;
}

SinglePointPart single_point_part(const PointerTrack& track, Point<Marker> tip,
                                  const std::vector<std::size_t>& still,
                                  const AccuracyOptions& options) {
  SinglePointPart part;
  part.start_s = track.tips[still.front()].time_s;
  part.end_s = track.tips[still.back()].time_s;
  part.spread = tip_spread(picked(track.tips, still));
  part.predicted_rms_m = predicted_rms_m(track, tip, still);
  part.judged.push_back(
      judged("95 % of the tips from their mean", part.spread.p95_m, options.single_point_p95));
  return part;
}

Result<TurningPart> turning_part(const PointerTrack& track, const ToolGeometry& pointer,
                                 const Dimple& dimple, const std::vector<std::size_t>& still,
                                 const AccuracyOptions& options) {
  const auto pivot = fit_in(track, dimple);
  if (!pivot) {
    return pivot.error();
  }
  // While the pointer is held still, all tips have the same tilt and would only dilute the spread.
  std::vector<std::size_t> turning;
  std::set_difference(dimple.samples.begin(), dimple.samples.end(), still.begin(), still.end(),
                      std::back_inserter(turning));
  if (turning.size() < kLeastStillSamples) {
    return refused(
        "accuracy test: %.0f measured poses while the pointer turned in the dimple, at "
        "least %.0f are needed",
        static_cast<double>(turning.size()), static_cast<double>(kLeastStillSamples));
  }
  TurningPart part;
  part.start_s = track.tips[turning.front()].time_s;
  part.end_s = track.tips[turning.back()].time_s;
  const std::vector<TipSample> tips = picked(track.tips, turning);
  part.spread = tip_spread(tips);
  const std::vector<double> tilts = tilts_rad(track, pointer.axis_in_marker, turning);
  part.largest_tilt_rad = *std::max_element(tilts.begin(), tilts.end());
  part.bins = bins_of(tips, part.spread.mean_m, tilts);
  part.tip_bias_m = pivot->fit.tip_in_marker - pointer.tip_in_marker;
  part.tip_bias_sigma_m = pivot->sigma_m;
  part.residual_rms_m = pivot->fit.rmse_m;
  part.judged.push_back(
      judged("95 % of the tips from their mean", part.spread.p95_m, options.turning_p95));
  part.judged.push_back(
      judged("tip from where the tool file has it", part.tip_bias_m.norm(), options.tip_bias));
  return part;
}

Result<DistancePart> distance_part(const PointerTrack& track, const std::vector<TipRest>& touches,
                                   std::span<const Vec3> board_points_m,
                                   const AccuracyOptions& options) {
  std::vector<Vec3> rests_m;
  for (const TipRest& rest : touches) {
    rests_m.push_back(tip_spread(picked(track.tips, rest.samples)).mean_m);
  }
  const auto matched = board_touches(rests_m, board_points_m, kMaxStrayRests);
  if (!matched) {
    return Error{"accuracy test: " + matched.error().message};
  }
  DistancePart part;
  part.stray_rests = touches.size() - board_points_m.size();
  part.fit_rmse_m = matched->fit_rmse_m;
  std::vector<Vec3> touched_m;
  for (std::size_t i = 0; i < board_points_m.size(); ++i) {
    const TipRest& rest = touches[matched->rest_of_point[i]];
    touched_m.push_back(rests_m[matched->rest_of_point[i]]);
    const double middle_s =
        (track.tips[rest.samples.front()].time_s + track.tips[rest.samples.back()].time_s) / 2;
    part.points.push_back(
        {middle_s, rest.samples.size(), board_points_m[i], matched->residual_m[i]});
  }
  const TipRest& first = touches[matched->rest_of_point.front()];
  const TipRest& last = touches[matched->rest_of_point.back()];
  part.start_s = track.tips[first.samples.front()].time_s;
  part.end_s = track.tips[last.samples.back()].time_s;
  add_distances(touched_m, board_points_m, part);
  part.judged.push_back(
      judged("mean error of the distances", std::abs(part.mean_error_m), options.distance_mean));
  part.judged.push_back(
      judged("largest error of a distance", part.max_error_m, options.distance_max));
  if (part.fit_rmse_m > kMaxBoardRmse_m) {
    part.failure = with_numbers(
        "the touches lie %.1f mm RMS from the board's points, limit %.1f mm: another board, "
        "another order, or a wrong size",
        part.fit_rmse_m * 1e3, kMaxBoardRmse_m * 1e3);
  }
  return part;
}

}  // namespace orthonav::nav
