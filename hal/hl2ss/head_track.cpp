#include "hal/hl2ss/head_track.h"

#include "hal/api/head_among.h"

namespace orthonav::hl2ss {
namespace {

/// Head poses of two streams agree to millimetres; the rest of the limit allows for predictions
/// past the newest one.
constexpr double kSameMapM = 0.05;
constexpr double kSameMapRad = 0.13;

}  // namespace

void HeadTrack::add(Timestamp time, const Transform<World, Rig>& world_from_rig,
                    std::int64_t map_epoch) {
  const MutexLock lock(mutex_);
  if (map_epoch != map_epoch_) {
    samples_.clear();
  }
  map_epoch_ = map_epoch;
  if (!samples_.empty() && time <= samples_.back().time) {
    return;
  }
  if (samples_.size() == kMaxSamples) {
    samples_.pop_front();
  }
  samples_.push_back({time, world_from_rig});
}

void HeadTrack::lose() {
  const MutexLock lock(mutex_);
  samples_.clear();
}

std::int64_t HeadTrack::place(Timestamp at,
                              std::optional<Transform<World, Rig>>& world_from_rig) const {
  const MutexLock lock(mutex_);
  const auto head = head_among(samples_.begin(), samples_.end(), at);
  if (!world_from_rig || head.status == PoseStatus::kLost ||
      (world_from_rig->translation() - head.value.translation()).norm() > kSameMapM ||
      rotation_angle_rad(world_from_rig->rotation(), head.value.rotation()) > kSameMapRad) {
    world_from_rig.reset();
  }
  return map_epoch_;
}

std::optional<Timestamp> HeadTrack::do_newest_measurement() const {
  const MutexLock lock(mutex_);
  if (samples_.empty()) {
    return std::nullopt;
  }
  return samples_.back().time;
}

Tracked<Transform<World, Rig>> HeadTrack::do_world_from_rig(Timestamp at) const {
  const MutexLock lock(mutex_);
  return head_among(samples_.begin(), samples_.end(), at);
}

}  // namespace orthonav::hl2ss
