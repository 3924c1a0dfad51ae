#include "hal/sim/cameras/head_track.h"

#include <algorithm>
#include <cmath>

namespace orthonav::sim {
namespace {

/// How slowly the lasting part of a tracker's error changes.
constexpr double kSlowest_hz = 0.1;
constexpr double kFastest_hz = 2.0;

}  // namespace

HeadTrack::HeadTrack(const Random& random, const ErrorModel& error_model, double told_sd_factor)
    : random_(random),
      noise_m_(error_model.head_pose_noise_m),
      noise_rad_(error_model.head_pose_noise_rad),
      told_variance_factor_(told_sd_factor * told_sd_factor),
      fresh_(std::sqrt(1.0 - error_model.head_pose_lasting)),
      lasting_m_(random.fork("lasting position"),
                 noise_m_ * std::sqrt(error_model.head_pose_lasting), kSlowest_hz, kFastest_hz),
      lasting_rad_(random.fork("lasting rotation"),
                   noise_rad_ * std::sqrt(error_model.head_pose_lasting), kSlowest_hz,
                   kFastest_hz) {}

void HeadTrack::add(std::int64_t frame, Timestamp time, const Transform<World, Rig>& pose,
                    Timestamp before, const Transform<World, Rig>& pose_before) {
  // One random stream per frame, so that skipped frames don't change the others' noise.
  Random noise = random_.fork(static_cast<std::uint64_t>(frame));
  const double time_s = seconds(time.time_since_epoch());
  const Vec3 translation_m = normal_vector(noise, fresh_ * noise_m_) + lasting_m_.at(time_s);
  const Vec3 rotation_rad = normal_vector(noise, fresh_ * noise_rad_) + lasting_rad_.at(time_s);
  nodes_[count_++ % kKept] = {time, before, pose, pose_before, translation_m, rotation_rad};
}

std::optional<Timestamp> HeadTrack::newest() const {
  if (count_ == 0) {
    return std::nullopt;
  }
  return back(0).time;
}

Transform<World, Rig> HeadTrack::noisy(const Node& node, const Transform<World, Rig>& pose) {
  return {pose.rotation() * rotation_from_vector(node.rotation_rad),
          pose.translation() + node.translation_m};
}

Tracked<Transform<World, Rig>> HeadTrack::at(Timestamp time) const {
  return at(time, Timestamp::max());
}

Tracked<Transform<World, Rig>> HeadTrack::at(Timestamp time, Timestamp known) const {
  Tracked<Transform<World, Rig>> answer;
  answer.time = time;
  const std::size_t size = std::min(count_, kKept);
  std::size_t steps = 0;
  while (steps < size && back(steps).time > known) {
    ++steps;
  }
  if (steps == size) {
    return answer;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    answer.covariance[i * 7] = told_variance_factor_ * noise_m_ * noise_m_;
    answer.covariance[(i + 3) * 7] = told_variance_factor_ * noise_rad_ * noise_rad_;
  }
  const Node& newest = back(steps);
  if (time >= newest.time) {
    const double ahead = seconds(time - newest.before) / seconds(newest.time - newest.before);
    answer.value = noisy(newest, interpolated(newest.pose_before, newest.pose, ahead));
    answer.status = time == newest.time ? PoseStatus::kMeasured : PoseStatus::kPredicted;
    return answer;
  }
  while (steps < size && back(steps).time > time) {
    ++steps;
  }
  if (steps == size) {
    return answer;
  }
  const Node& a = back(steps);
  const Node& b = back(steps - 1);
  answer.value = interpolated(noisy(a, a.pose), noisy(b, b.pose),
                              seconds(time - a.time) / seconds(b.time - a.time));
  if (time == a.time) {
    answer.value = noisy(a, a.pose);
  }
  answer.status = PoseStatus::kMeasured;
  return answer;
}

Transform<World, World> HeadTrack::actual_from_reported(Timestamp frame) const {
  const std::size_t size = std::min(count_, kKept);
  for (std::size_t steps = 0; steps < size; ++steps) {
    const Node& node = back(steps);
    if (node.time == frame) {
      return node.pose * noisy(node, node.pose).inverse();
    }
  }
  return {};
}

}  // namespace orthonav::sim
