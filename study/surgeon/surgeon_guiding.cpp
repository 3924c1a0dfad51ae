#include <algorithm>
#include <cmath>
#include <numbers>

#include "study/surgeon/scripted_surgeon.h"

namespace orthonav::sim {
namespace {

constexpr double kQuickLook_s = 0.1;
constexpr double kLook_s = 0.6;
constexpr double kMoveHead_s = 2.0;
constexpr double kOverBone_m = 0.030;
constexpr double kBoneSearch_m = 0.015;

}  // namespace

Script ScriptedSurgeon::guide(std::size_t level, Side side) {
  const StepOnDisplay step = step_now();
  if (!driven_.contains(step)) {
    co_await body_.take(ToolKind::kGuide, layout_->site(level));
    Aim aim;
    co_await find_entry(step, level, side, aim);
    if (!in_step(step) || finished_) {
      co_return;
    }
    co_await set_on(aim);
    co_await aim_tool(step, level, aim);
    if (!in_step(step) || finished_) {
      co_return;
    }
    co_await drive_wire(level, side, aim);
    driven_.insert(step);
  }
  body_.say(words().next);
}

Script ScriptedSurgeon::set_on(const Aim& aim) {
  const double guess_rad = body_.random().uniform(0.5, 1.0) * error_model_->first_guess_rad;
  const double where = body_.random().uniform(0.0, 2.0 * std::numbers::pi);
  const Vec3 across = perpendicular_to(aim.outwards);
  const Vec3 tilt = std::cos(where) * across + std::sin(where) * aim.outwards.cross(across);
  const Vec3 axis = rotation_from_vector(guess_rad * tilt) * aim.outwards;
  const Point<Room> tip{aim.on_bone.point};
  co_await body_.move({tip + kOverBone_m * axis, axis, 0.0}, 1.2);
  co_await body_.move({tip, axis, 0.0}, 1.2);
  body_.posture().contact_normal = aim.on_bone.normal;
  // The bone yields to the instrument while it is pressed.
  body_.posture().pushed_m =
      std::abs(body_.random().normal(0.0, error_model_->push_m)) * Vec3{0, -1, 0};
}

Script ScriptedSurgeon::aim_tool(const StepOnDisplay& step, std::size_t level, const Aim& aim) {
  switch (guidance_) {
    case GuidanceProfile::kOverlay:
      co_await align_by_eye(step, aim);
      break;
    case GuidanceProfile::kPublished:
    case GuidanceProfile::kNumbers:
      co_await rotate_tool(step, aim);
      break;
    case GuidanceProfile::kClosedLoop:
      co_await centre_tip(step, level, aim);
      co_await rotate_tool(step, aim);
      co_await centre_tip(step, level, aim);
      break;
  }
}

BoneSpot ScriptedSurgeon::put_on_bone(std::size_t level, Vec3 entry, Vec3 outwards) const {
  const auto& room_from_vertebra = layout_->room_from_vertebra(level);
  const auto vertebra_from_room = room_from_vertebra.inverse();
  const Vec3 at = (vertebra_from_room * Point<Room>{entry}).v;
  const Vec3 inwards = (vertebra_from_room * Direction<Room>{-outwards}).v;
  const BoneSurface& bone = layout_->bone(level);
  const auto hit = bone.first_hit(at - kBoneSearch_m * inwards, inwards, 2.0 * kBoneSearch_m);
  const BoneSpot spot = hit ? *hit : bone.closest(at);
  return {(room_from_vertebra * Point<Vertebra>{spot.point}).v,
          (room_from_vertebra * Direction<Vertebra>{spot.normal}).v};
}

Script ScriptedSurgeon::find_entry(const StepOnDisplay& step, std::size_t level, Side side,
                                   Aim& aim) {
  const Vec3 perceived_offset =
      misperceived(layout_->site(level), error_model_->overlay_perception_m) +
      normal_vector(body_.random(), error_model_->entry_pick_m);
  // First a glance for the direction, to stand correctly; then a look for the place.
  for (const double look_s : {kQuickLook_s, kLook_s}) {
    bool found = false;
    Vec3 entry;
    co_await look_at_entry(step, level, side, look_s, found, entry, aim.outwards);
    if (!found) {
      co_return;
    }
    aim.on_bone = put_on_bone(level, entry + perceived_offset, aim.outwards);
    body_.look({aim.on_bone.point}, best_view(aim.outwards));
    if (look_s == kQuickLook_s) {
      co_await body_.rest(kMoveHead_s);
    }
  }
}

Script ScriptedSurgeon::look_at_entry(const StepOnDisplay& step, std::size_t level, Side side,
                                      double look_s, bool& found, Vec3& entry, Vec3& outwards) {
  const std::string& label = layout_->room().levels[level].label;
  const Timestamp patience = body_.now() + from_seconds(kLongPatience_s);
  Vec3 entries;
  Vec3 axes;
  int frames = 0;
  Duration looked{};
  const Vec3 from = body_.posture().head.from_gaze;
  Timestamp last_seen = body_.now();
  for (Timestamp before = body_.now(); looked < from_seconds(look_s); before = body_.now()) {
    co_await body_.next_tick();
    if (body_.now() > patience) {
      give_up();
    }
    if (!in_step(step) || finished_) {
      co_return;
    }
    const ShownHologram* spot = eyes_.find_entry(label, side);
    const ShownHologram* path = eyes_.find(HologramKind::kTrajectory);
    if (!sees_now() || !spot || spot->points_in_world.empty() || !path ||
        path->points_in_world.size() < 3) {
      lean_where_lost(layout_->site(level), from, seconds(body_.now() - last_seen));
      continue;
    }
    last_seen = body_.now();
    const Vec3 axis = eyes_.place(path->points_in_world[0]) - eyes_.place(path->points_in_world[2]);
    const Point<Room> place = seen_at_rest(spot->points_in_world[0]);
    if (!(axis.norm() > 1e-3) || !place.v.is_finite()) {
      continue;
    }
    entries += place.v;
    axes += axis.normalized();
    looked += body_.now() - before;
    ++frames;
  }
  entry = entries / frames;
  outwards = axes.normalized();
  found = true;
}

Script ScriptedSurgeon::drive_wire(std::size_t level, Side side, const Aim& aim) {
  const HandWhileDrilling hand = hand_while_drilling(*error_model_, guidance_);
  const Vec3 axis = body_.posture().grip.axis;
  const Vec3 rotation_rad = across_axis(normal_vector(body_.random(), hand.of_wire_rad), axis);
  const Vec3 unseen = across_axis(normal_vector(body_.random(), hand.unseen_rad), axis);
  body_.posture().contact_normal.reset();
  body_.posture().drilling = Drilling{level, side, 0.0, unseen};
  co_await drill(aim, rotation_rad);
  co_await body_.rest(0.3);
  body_.posture().drilling.reset();
  co_await body_.next_tick();
  body_.posture().pushed_m = {};
  Grip out = body_.posture().grip;
  out.tip = Point<Room>{aim.on_bone.point} + kOverBone_m * out.axis;
  co_await body_.move(out, 1.0);
}

Script ScriptedSurgeon::drill(const Aim& aim, Vec3 rotation_of_wire) {
  const Grip pierced = body_.posture().grip;
  const double length_s = body_.slowness() * kDriving_s;
  Timestamp begin = body_.now();
  Timestamp before = begin;
  Timestamp last_seen = begin;
  DeviationMemory memory;
  Vec3 corrected;
  for (double t = 0.0; t < 1.0;) {
    co_await body_.next_tick();
    if (guidance_ == GuidanceProfile::kClosedLoop) {
      const auto reading = read_rotation();
      const double lost_s = seconds(body_.now() - last_seen);
      if (!reading && lost_s < kPatience_s &&
          lean_where_lost({aim.on_bone.point}, best_view(aim.outwards), lost_s)) {
        // Nobody drills on by numbers that are gone.
        begin += body_.now() - before;
        before = body_.now();
        continue;
      }
      if (reading) {
        last_seen = body_.now();
        memory.add(*reading);
        if (const auto acted_on = memory.newest(body_.now() - from_seconds(kReaction_s))) {
          const double part = kGain_per_s * seconds(body_.now() - before);
          corrected += part * across_axis(acted_on->rotation_rad + misread_rad_, pierced.axis);
        }
      }
    }
    before = body_.now();
    t = std::min(1.0, seconds(body_.now() - begin) / length_s);
    const double way = minimum_jerk(t);
    Grip& grip = body_.posture().grip;
    // The axis of the wire is the chord of its way, which turns by half of what the hand does.
    grip.axis = (rotation_from_vector(corrected + 2.0 * way * rotation_of_wire) * pierced.axis)
                    .normalized();
    grip.tip = pierced.tip - way * kAdvance_m * grip.axis;
    body_.posture().drilling->way = way;
  }
}

}  // namespace orthonav::sim
