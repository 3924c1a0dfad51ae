#include "nav/tracking/tool_tracker.h"

#include <cmath>
#include <string>

#include "base/joined.h"
#include "nav/tracking/tag_pose.h"

namespace orthonav::nav {
namespace {

// A hand's motion between two pairs as white acceleration: about 1 m/s² and 10 rad/s² held for 0.1
// s (density = acceleration² · duration).
constexpr double kAccelerationSpectrum_m2_per_s3 = 0.1;
constexpr double kAccelerationSpectrum_rad2_per_s3 = 10.0;
// Without a usable older pose the velocity is unknown: the SDs allow for a fast reach and a fast
// turn of the wrist.
constexpr double kUnknownSpeedM = 0.3;    // m/s
constexpr double kUnknownSpeedRad = 1.5;  // rad/s
// Older pairs say nothing about the velocity now.
constexpr double kLongestBaselineS = 0.2;

void add_motion(PoseCovariance& covariance, double translation, double rotation) {
  for (std::size_t i = 0; i < 3; ++i) {
    covariance[7 * i] += translation;
  }
  for (std::size_t i = 3; i < 6; ++i) {
    covariance[7 * i] += rotation;
  }
}

}  // namespace

Status check(const StereoCalibration& calibration, const std::vector<ToolGeometry>& tools,
             const TrackerOptions& options) {
  if (const auto problems = problems_of(tools); !problems.empty()) {
    return Error{"tools: " + joined(problems)};
  }
  for (const ToolGeometry& tool : tools) {
    if (!tool.has_tag()) {
      return Error{"tools: tool '" + tool.name +
                   "' has no tag, and cameras find a tool by its tag alone"};
    }
  }
  if (calibration.left.width_px() <= 0 || calibration.right.width_px() <= 0) {
    return Error{"tracker: the stereo calibration has no camera model"};
  }
  if (options.full_search_interval < 1) {
    return Error{"tracker: full_search_interval " + std::to_string(options.full_search_interval) +
                 ", must be at least 1"};
  }
  if (options.coast < Duration::zero()) {
    return Error{"tracker: coast is negative"};
  }
  return {};
}

void add_head(ToolState& state, const StereoFrame& frame) {
  TrackedPose& pose = state.world_from_marker;
  if (!frame.world_from_rig || !frame.head_covariance || pose.status == PoseStatus::kLost) {
    return;
  }
  const Vec3 lever_arm_m = pose.value.translation() - frame.world_from_rig->translation();
  pose.covariance = plus_carried(pose.covariance, *frame.head_covariance, lever_arm_m);
}

TrackedPose predicted(const TrackedPose& older, const TrackedPose& newer, Timestamp time,
                      Duration coast) {
  TrackedPose pose;
  pose.time = time;
  if (newer.status != PoseStatus::kMeasured || time - newer.time > coast) {
    return pose;
  }
  if (time == newer.time) {
    return newer;
  }
  const double baseline_s = seconds(newer.time - older.time);
  const bool moving =
      older.status == PoseStatus::kMeasured && baseline_s > 0.0 && baseline_s <= kLongestBaselineS;
  const double ahead_s = seconds(time - newer.time);
  if (ahead_s < 0.0 && (!moving || time < older.time)) {
    return pose;
  }

  pose.status = PoseStatus::kPredicted;
  const double dt = std::abs(ahead_s);
  const double grown = dt * dt * dt / 3.0;
  if (!moving) {
    pose.value = newer.value;
    pose.covariance = newer.covariance;
    add_motion(
        pose.covariance,
        kUnknownSpeedM * kUnknownSpeedM * dt * dt + kAccelerationSpectrum_m2_per_s3 * grown,
        kUnknownSpeedRad * kUnknownSpeedRad * dt * dt + kAccelerationSpectrum_rad2_per_s3 * grown);
    return pose;
  }
  const double a = ahead_s / baseline_s;
  pose.value = interpolated(older.value, newer.value, 1.0 + a);
  // value = (1 + a) newer - a older, to first order in the rotation as well.
  for (std::size_t i = 0; i < pose.covariance.size(); ++i) {
    pose.covariance[i] = (1.0 + a) * (1.0 + a) * newer.covariance[i] + a * a * older.covariance[i];
  }
  add_motion(pose.covariance, kAccelerationSpectrum_m2_per_s3 * grown,
             kAccelerationSpectrum_rad2_per_s3 * grown);
  return pose;
}

}  // namespace orthonav::nav
