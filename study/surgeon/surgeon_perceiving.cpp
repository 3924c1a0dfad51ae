#include <algorithm>

#include "study/surgeon/scripted_surgeon.h"

namespace orthonav::sim {
namespace {

/// Holding a tool along a line takes some seconds.
constexpr double kAligning_s = 3.0;
/// A tip this near to the axis is on it.
constexpr double kCentred_m = 0.0004;
/// The numbers are read for this long, then the tip is moved; the total time is limited.
constexpr double kReading_s = 0.6;
constexpr double kMoving_s = 0.5;
constexpr int kMaxMoves = 6;
constexpr double kPatienceForNumbers_s = 20.0;
constexpr int kFewestNumbers = 5;
/// One digit misread as another.
constexpr double kMisread_m = 0.001;

}  // namespace

Vec3 ScriptedSurgeon::misperceived(Random& random, Point<Room> place, double across_sd_m) const {
  const Vec3 off = normal_vector(random, across_sd_m);
  const Vec3 sight = (place - bearings_.eyes).normalized();
  const double more = std::max(1.0, error_model_->perception_depth_ratio) - 1.0;
  return off + more * off.dot(sight) * sight;
}

Script ScriptedSurgeon::align_by_eye(const StepOnDisplay& step, const Aim& aim) {
  if (!in_step(step)) {
    co_return;
  }
  const Vec3 off = normal_vector(body_.random(), error_model_->overlay_aligning_rad);
  Grip held = body_.posture().grip;
  held.axis = (rotation_from_vector(off) * aim.outwards).normalized();
  co_await body_.move(held, kAligning_s);
}

Script ScriptedSurgeon::read_offset(const StepOnDisplay& step, const Aim& aim,
                                    std::optional<Vec3>& offset_m) {
  offset_m.reset();
  Vec3 sum;
  int readings = 0;
  std::optional<Timestamp> last;
  const Timestamp patience = body_.now() + from_seconds(kPatienceForNumbers_s);
  const Timestamp start = body_.now();
  Timestamp before = start;
  Timestamp last_seen = start;
  while (body_.now() < patience && in_step(step) &&
         (body_.now() - start < from_seconds(kReading_s) || readings < kFewestNumbers)) {
    co_await body_.next_tick();
    const double tick_s = seconds(body_.now() - before);
    before = body_.now();
    const auto offset = read_tip_offset(eyes_, aim.outwards);
    if (!sees_now() || !offset) {
      if (relies_on_reference_) {
        regain_reading(aim, seconds(body_.now() - last_seen), tick_s);
      }
      continue;
    }
    last_seen = body_.now();
    if (eyes_.seen_at() == last) {
      continue;
    }
    last = eyes_.seen_at();
    sum += *offset;
    ++readings;
  }
  if (readings >= kFewestNumbers) {
    offset_m = sum / readings;
  }
}

Script ScriptedSurgeon::centre_tip(const StepOnDisplay& step, std::size_t level, const Aim& aim) {
  for (int moves = 0; moves < kMaxMoves && in_step(step) && !finished_; ++moves) {
    std::optional<Vec3> offset_m;
    co_await read_offset(step, aim, offset_m);
    if (!offset_m || offset_m->norm() < kCentred_m) {
      co_return;
    }
    Vec3 misread = normal_vector(body_.random(), 0.25 * error_model_->entry_pick_m);
    if (body_.random().uniform() < error_model_->misreading_probability) {
      misread = misread + kMisread_m * perpendicular_to(aim.outwards);
    }
    Grip grip = body_.posture().grip;
    const BoneSpot spot = put_on_bone(level, (grip.tip - *offset_m + misread).v, aim.outwards);
    grip.tip = {spot.point};
    co_await body_.move(grip, kMoving_s);
    body_.posture().contact_normal = spot.normal;
  }
}

}  // namespace orthonav::sim
