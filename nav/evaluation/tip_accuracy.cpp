#include "nav/evaluation/tip_accuracy.h"

#include <algorithm>
#include <cmath>

#include "base/angle.h"
#include "base/findings.h"
#include "base/printed.h"
#include "nav/evaluation/fixed_point.h"
#include "nav/evaluation/tip_accuracy_parts.h"

namespace orthonav::nav {
namespace {

/// A rest nearer than this to the dimple is in the dimple, or has slipped out of it.
constexpr double kDimple_m = 0.025;
/// If the mean tip before and after some moment differs by more than this, it slipped.
constexpr double kMaxSlip_m = 0.0015;

void check_limits(const char* name, const AccuracyLimits& limits,
                  std::vector<std::string>& problems) {
  if (limits.pass_m > 0.0 && limits.pass_m <= limits.note_m && limits.note_m <= 0.1) {
    return;
  }
  problems.push_back(
      printed("accuracy test: limits of %s %g and %g mm, must rise from above 0 to 100 mm", name,
              limits.pass_m * 1e3, limits.note_m * 1e3));
}

Status check_input(std::span<const Vec3> board_points_m, const AccuracyOptions& options) {
  const std::vector<std::string> problems = options.check();
  if (!problems.empty()) {
    return Error{problems.front()};
  }
  if (!board_points_m.empty() && board_points_m.size() < 3) {
    return refused("board: %.0f points to touch, at least %.0f are needed",
                   static_cast<double>(board_points_m.size()), 3);
  }
  // The board's points must be far enough apart to be distinguished by rests.
  for (std::size_t i = 0; i < board_points_m.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (!((board_points_m[i] - board_points_m[k]).norm() >= 3.0 * kRestRadius_m)) {
        return refused("board: two points to touch are %.1f mm apart, at least %.1f mm are needed",
                       (board_points_m[i] - board_points_m[k]).norm() * 1e3, 3e3 * kRestRadius_m);
      }
    }
  }
  return {};
}

Result<PointerTrack> measured_track(std::span<const TrackedPose> poses, Point<Marker> tip) {
  PointerTrack track;
  for (const TrackedPose& pose : poses) {
    if (pose.status != PoseStatus::kMeasured) {
      continue;
    }
    const Vec3 tip_m = (pose.value * tip).v;
    if (!tip_m.is_finite()) {
      return Error{"accuracy test: a pose is not finite"};
    }
    auto& kept = track.world_from_marker;
    if (!kept.empty() && pose.time <= kept.back().time) {
      return Error{"accuracy test: the times of the poses do not increase"};
    }
    kept.push_back(pose);
    track.tips.push_back({seconds(pose.time - kept.front().time), tip_m});
  }
  return track;
}

/// The point about which the pointer turned in the dimple.
Result<FixedPoint> rotated_about(const PointerTrack& track, Point<Marker> tip) {
  const auto found = longest_fixed_point(track.world_from_marker, tip);
  if (!found) {
    return refused(
        "accuracy test: the pointer never turned about its resting tip, must do so for "
        "at least %.1f s and %.1f° RMS about every axis",
        kLeastTurning_s, degrees(kLeastTurningSpread_rad));
  }
  return *found;
}

/// Where the tool's fixed point is during the stretch found.
Vec3 fixed_place(const PointerTrack& track, const FixedPoint& found) {
  Vec3 sum_m{};
  for (std::size_t i = found.first; i < found.end; ++i) {
    sum_m += track.fixed[i].tip_m;
  }
  return sum_m / static_cast<double>(found.end - found.first);
}

void add_fixed_points(Vec3 tip_m, PointerTrack& track) {
  for (std::size_t i = 0; i < track.tips.size(); ++i) {
    track.fixed.push_back(
        {track.tips[i].time_s, (track.world_from_marker[i].value * Point<Marker>{tip_m}).v});
  }
}

/// The rests, sorted: in the dimple; away from it (touches); and next to it for so long that the
/// pointer must have slipped out.
struct SortedRests {
  Dimple dimple;
  std::vector<TipRest> touches;
  std::optional<TipSlip> slip;
};

SortedRests sorted_rests(const PointerTrack& track, const FixedPoint& found) {
  SortedRests out;
  out.dimple.offset_m = found.offset_m;
  out.dimple.point_m = fixed_place(track, found);
  for (const TipRest& rest : tip_rests(track.fixed)) {
    const double off_m = (rest.mean_m - out.dimple.point_m).norm();
    auto& dimple = out.dimple.samples;
    const double length_s =
        track.fixed[rest.samples.back()].time_s - track.fixed[rest.samples.front()].time_s;
    if (off_m <= kRestRadius_m) {
      dimple.insert(dimple.end(), rest.samples.begin(), rest.samples.end());
    } else if (off_m > kDimple_m) {
      out.touches.push_back(rest);
    } else if (length_s >= kLeastStill_s && (!out.slip || off_m > out.slip->step_m)) {
      out.slip = TipSlip{track.fixed[rest.samples.front()].time_s, off_m};
    }
  }
  return out;
}

void note_slip(const std::optional<TipSlip>& slip, AccuracyPart& part) {
  if (!slip || !part.failure.empty()) {
    return;
  }
  part.failure =
      printed("the tip slipped by %.1f mm about %.1f s into the recording: repeat the test",
              slip->step_m * 1e3, slip->time_s);
}

void note_slips(const PointerTrack& track, const SortedRests& rests,
                const std::vector<std::size_t>& still, AccuracyReport& report) {
  note_slip(tip_slip(picked(track.tips, still), kMaxSlip_m), report.single_point);
  note_slip(rests.slip, report.turning);
  note_slip(tip_slip(picked(track.fixed, rests.dimple.samples), kMaxSlip_m), report.turning);
}

/// The track of the measured poses, once input and options are known to be good.
Result<PointerTrack> checked_track(std::span<const TrackedPose> world_from_marker,
                                   const ToolGeometry& pointer,
                                   std::span<const Vec3> board_points_m,
                                   const AccuracyOptions& options) {
  if (Status s = check_input(board_points_m, options); !s) {
    return s.error();
  }
  auto track = measured_track(world_from_marker, pointer.tip_in_marker);
  if (track && track->tips.size() < 2 * kLeastStillSamples) {
    return refused("accuracy test: %.0f measured poses of the pointer, at least %.0f are needed",
                   static_cast<double>(track->tips.size()),
                   2.0 * static_cast<double>(kLeastStillSamples));
  }
  return track;
}

}  // namespace

std::vector<std::string> AccuracyOptions::check() const {
  std::vector<std::string> problems;
  check_limits("single_point_p95", single_point_p95, problems);
  check_limits("turning_p95", turning_p95, problems);
  check_limits("tip_bias", tip_bias, problems);
  check_limits("distance_mean", distance_mean, problems);
  check_limits("distance_max", distance_max, problems);
  return problems;
}

Verdict AccuracyPart::verdict() const {
  Verdict worst = failure.empty() ? Verdict::kPass : Verdict::kFail;
  for (const Judged& figure : judged) {
    worst = std::max(worst, figure.verdict);
  }
  return worst;
}

Verdict AccuracyReport::verdict() const {
  Verdict worst = std::max(single_point.verdict(), turning.verdict());
  if (distances) {
    worst = std::max(worst, distances->verdict());
  }
  return worst;
}

Result<AccuracyReport> test_tip_accuracy(std::span<const TrackedPose> world_from_marker,
                                         const ToolGeometry& pointer,
                                         std::span<const Vec3> board_points_m,
                                         const AccuracyOptions& options) {
  auto track = checked_track(world_from_marker, pointer, board_points_m, options);
  if (!track) {
    return track.error();
  }
  const auto found = rotated_about(*track, pointer.tip_in_marker);
  if (!found) {
    return found.error();
  }
  add_fixed_points(pointer.tip_in_marker.v + found->offset_m, *track);
  const SortedRests rests = sorted_rests(*track, *found);

  AccuracyReport report;
  report.samples = track->tips.size();
  report.duration_s = track->tips.back().time_s;
  const auto still = still_stretch(*track, rests.dimple);
  if (!still) {
    return still.error();
  }
  report.single_point = single_point_part(*track, pointer.tip_in_marker, *still, options);
  auto turning = turning_part(*track, pointer, rests.dimple, *still, options);
  if (!turning) {
    return turning.error();
  }
  report.turning = std::move(*turning);
  note_slips(*track, rests, *still, report);
  if (board_points_m.empty()) {
    return report;
  }
  auto distances = distance_part(*track, rests.touches, board_points_m, options);
  if (!distances) {
    return distances.error();
  }
  report.distances = std::move(*distances);
  return report;
}

}  // namespace orthonav::nav
