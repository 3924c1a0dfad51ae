#include "hal/api/map_watch.h"

#include <algorithm>

#include "hal/api/head_among.h"
#include "hal/api/research_mode.h"

namespace orthonav {
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
constexpr Duration kMaxUnseen = std::chrono::milliseconds(250);
/// After this long without a pose, the map can't be assumed to be the same.
constexpr Duration kVouchedFor = std::chrono::seconds(10);

/// The time in which a head went from one pose to the next. A camera takes no two pictures within
/// less than its interval: stamps that are closer are wrong, and give no speed.
double interval_s(Duration stamped) { return seconds(std::max(stamped, kGreyCameraInterval)); }

}  // namespace

bool MapWatch::is_possible(const Seen& next) const {
  const Duration passed = next.time - last_->time;
  if (passed > kVouchedFor) {
    return false;
  }
  const double dt_s = interval_s(std::min(passed + ignored_, kMaxUnseen));
  const auto within = [&](const Transform<World, Rig>& expected, double limit_m, double limit_rad) {
    const auto& pose = next.world_from_rig;
    return (pose.translation() - expected.translation()).norm() <= limit_m &&
           rotation_angle_rad(pose.rotation(), expected.rotation()) <= limit_rad;
  };
  if (!within(last_->world_from_rig, kNoiseM + kFastestHead_m_s * dt_s,
              kNoiseRad + kFastestHead_rad_s * dt_s)) {
    return false;
  }
  if (!before_ || passed + ignored_ > kSpeedWithin) {
    return true;
  }
  const double before_s = interval_s(last_->time - before_->time);
  const auto expected =
      interpolated(before_->world_from_rig, last_->world_from_rig, 1.0 + dt_s / before_s);
  // The speed is one of the past interval's middle.
  const double lever_s2 = dt_s * 0.5 * (dt_s + before_s);
  return within(expected, kNoiseM + kMaxAcceleration * lever_s2,
                kNoiseRad + kMaxAngularAcceleration * lever_s2);
}

bool MapWatch::moved(Timestamp time, const Transform<World, Rig>& world_from_rig) {
  if (last_ && time <= last_->time) {
    // The one before may have been stamped too late as well: what it says about speed is nothing.
    ignored_ += kGreyCameraInterval;
    before_.reset();
    return false;
  }
  const Seen next{time, world_from_rig};
  const bool is_moved = last_ && (broken_off_ || !is_possible(next));
  broken_off_ = false;
  before_.reset();
  if (last_ && !is_moved && time - last_->time <= kSpeedWithin && ignored_ == Duration::zero()) {
    before_ = last_;
  }
  ignored_ = Duration::zero();
  last_ = next;
  return is_moved;
}

}  // namespace orthonav
