#include "hal/hl2ss/map_watch.h"

#include <algorithm>

#include "hal/api/head_among.h"

namespace orthonav::hl2ss {
namespace {

// A head at work stays below these as well. A false alarm costs a registration, a missed move a
// wrong hologram: at 30 Hz a move of more than 5 cm or 9 degrees is found.
constexpr double kMaxAcceleration = 30.0;          // m/s²
constexpr double kMaxAngularAcceleration = 100.0;  // rad/s²
constexpr double kNoiseM = 0.010;
constexpr double kNoiseRad = 0.020;
/// Two poses farther apart in time than this give no speed.
constexpr Duration kSpeedWithin = std::chrono::milliseconds(110);
/// Without poses, a head is assumed to move at most for this long at full speed.
constexpr double kMaxUnseenS = 0.25;
/// After this long without a pose, the map can't be assumed to be the same.
constexpr Duration kVouchedFor = std::chrono::seconds(10);
/// Head poses of two streams agree to millimetres; the rest of the limit allows for predictions
/// past the newest one.
constexpr double kSameMapM = 0.05;
constexpr double kSameMapRad = 0.13;

}  // namespace

bool MapWatch::is_possible(const Seen& next) const {
  const Duration passed = next.time - last_->time;
  if (passed > kVouchedFor) {
    return false;
  }
  const double dt_s = std::min(seconds(passed), kMaxUnseenS);
  const auto within = [&](const Transform<World, Rig>& expected, double limit_m, double limit_rad) {
    const auto& pose = next.world_from_rig;
    return (pose.translation() - expected.translation()).norm() <= limit_m &&
           rotation_angle_rad(pose.rotation(), expected.rotation()) <= limit_rad;
  };
  if (!within(last_->world_from_rig, kNoiseM + kFastestHead_m_s * dt_s,
              kNoiseRad + kFastestHead_rad_s * dt_s)) {
    return false;
  }
  if (!before_ || passed > kSpeedWithin) {
    return true;
  }
  const double before_s = seconds(last_->time - before_->time);
  const auto expected = interpolated(before_->world_from_rig, last_->world_from_rig,
                                     1.0 + seconds(passed) / before_s);
  // The speed is one of the past interval's middle.
  const double lever_s2 = dt_s * 0.5 * (dt_s + before_s);
  return within(expected, kNoiseM + kMaxAcceleration * lever_s2,
                kNoiseRad + kMaxAngularAcceleration * lever_s2);
}

bool MapWatch::moved(Timestamp time, const Transform<World, Rig>& world_from_rig) {
  if (last_ && time <= last_->time) {
    return false;
  }
  const Seen next{time, world_from_rig};
  const bool is_moved = last_ && (broken_off_ || !is_possible(next));
  broken_off_ = false;
  before_.reset();
  if (last_ && !is_moved && time - last_->time <= kSpeedWithin) {
    before_ = last_;
  }
  last_ = next;
  return is_moved;
}

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
