#include "hal/sim/head_track.h"

#include <algorithm>

namespace orthonav::sim {

HeadTrack::HeadTrack(const Random& random, const ErrorModel& error_model)
    : random_(random),
      noise_m_(error_model.head_pose_noise_m),
      noise_rad_(error_model.head_pose_noise_rad) {}

void HeadTrack::add(std::int64_t frame, Timestamp time, const Transform<World, Rig>& pose,
                    Timestamp before, const Transform<World, Rig>& pose_before) {
  // One random stream per frame, so that skipped frames don't change the others' noise.
  Random noise = random_.fork(static_cast<std::uint64_t>(frame));
  const Vec3 translation_m = normal_vector(noise, noise_m_);
  const Vec3 rotation_rad = normal_vector(noise, noise_rad_);
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
    answer.covariance[i * 7] = noise_m_ * noise_m_;
    answer.covariance[(i + 3) * 7] = noise_rad_ * noise_rad_;
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

}  // namespace orthonav::sim
