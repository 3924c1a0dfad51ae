#include <cmath>

#include "nav/tracking/tool_tracker.h"

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
