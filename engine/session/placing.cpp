#include "engine/session/placing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "engine/session/axis_check.h"
#include "engine/session/tool_in_vertebra.h"

namespace orthonav::engine {

void Placing::begin() {
  wire_.reset();
  no_other_entry_ = false;
  confirming_ = false;
  touch_.drop();
  recent_.clear();
  spin_.reset();
}

void Placing::collect(const nav::TrackedPose& pose, const nav::ToolGeometry& guide) {
  if (pose.status == PoseStatus::kMeasured) {
    touch_.add({pose.value * guide.tip_in_marker, (pose.value * guide.axis_in_marker).v});
    if (recent_.size() == 2 * kMostRecent) {
      recent_.erase(recent_.begin(), recent_.begin() + kMostRecent);
    }
    recent_.push_back(pose.value);
  } else {
    touch_.lose();
  }
}

std::optional<TouchRefusal> Placing::take(const LevelState& level, std::size_t screw,
                                          const nav::TrackedPose& pose,
                                          const nav::ToolGeometry& guide,
                                          const ToolErrors& guide_errors, double max_spread_m) {
  const auto taken = touch_.take(max_spread_m, rules_.most_turn_rad);
  if (const auto* refusal = std::get_if<TouchRefusal>(&taken)) {
    return *refusal;
  }
  RestingAxis resting = std::get<RestingAxis>(taken);
  use_turning(guide, resting);
  // The axis is the sleeve's own, below.
  const auto now = in_vertebra(*level.registration, pose, guide,
                               {guide_errors.walked_sd_m, guide_errors.unshared_sd_m});
  if (!now.uncertainty) {
    constexpr double kUnknown = std::numeric_limits<double>::infinity();
    return TouchRefusal{TouchRefusal::Kind::kEntryUnsure, kUnknown, rules_.most_entry_sd_m};
  }
  const auto vertebra_from_world = level.registration->world_from_vertebra.inverse();
  const nav::Axis<Vertebra> sleeve{
      vertebra_from_world * resting.mean.point,
      -(vertebra_from_world * Direction<World>{resting.mean.direction}).v};
  const double axis_sd_rad = spin_ ? sd_of_each_rad(*spin_) : rules_.axis_sd_rad;
  const nav::SleeveErrors errors{std::hypot(axis_sd_rad, rules_.play_rad, resting.direction_sd_rad),
                                 guide_errors.unshared_sd_m
                                     ? resting.tip_sd_m
                                     : std::hypot(rules_.tip_sd_m, resting.tip_sd_m)};
  const nav::PlacedAxis axis =
      nav::placed_axis(level.plan.screws[screw], sleeve, *now.uncertainty, errors);
  if (const auto refusal = refusal_of(axis)) {
    return refusal;
  }
  measured_ = Measured{sleeve, *now.uncertainty, errors, resting.pairs};
  put(axis);
  return std::nullopt;
}

void Placing::judge_again(const nav::ScrewPlan& plan) {
  put(nav::placed_axis(plan, measured_->sleeve, measured_->uncertainty, measured_->errors));
}

void Placing::put(const nav::PlacedAxis& axis) {
  wire_ = PlacedWire{axis, measured_->pairs, rules_.angle_limit_rad, rules_.entry_limit_m, false};
  no_other_entry_ = false;
  confirming_ = false;
}

/// Uses the latest unbroken run of poses in which the sleeve was on this wire.
void Placing::use_turning(const nav::ToolGeometry& guide, RestingAxis& resting) {
  constexpr double kSameWire_m = 0.006;
  constexpr double kSameWire_rad = 4.0 * kRadiansPerDegree;
  const auto on_wire = [&](const Transform<World, Marker>& pose) {
    return (pose * guide.tip_in_marker - resting.mean.point).norm() <= kSameWire_m &&
           angle_between_rad((pose * guide.axis_in_marker).v, resting.mean.direction) <=
               kSameWire_rad;
  };
  const std::span all = std::span<const Transform<World, Marker>>(recent_).last(
      std::min(recent_.size(), kMostRecent));
  const auto off = std::find_if_not(all.rbegin(), all.rend(), on_wire);
  const std::span<const Transform<World, Marker>> poses(off.base(), all.end());
  const auto found = nav::spin_calibration(poses, guide.tip_in_marker, guide.axis_in_marker);
  spin_ = found ? std::optional(*found) : std::nullopt;
  if (!spin_) {
    return;  // it was not turned
  }
  // Where the described axis is off, axis and tip circle the wire while the sleeve turns; their
  // means do not.
  Vec3 tip;
  Vec3 direction;
  for (const Transform<World, Marker>& pose : poses) {
    tip += (pose * guide.tip_in_marker).v;
    direction += (pose * spin_->axis_in_marker).v;
  }
  resting.mean = {{tip / static_cast<double>(poses.size())}, direction.normalized()};
  resting.pairs = poses.size();
}

std::optional<TouchRefusal> Placing::refusal_of(const nav::PlacedAxis& axis) const {
  using Kind = TouchRefusal::Kind;
  if (!(axis.entry_m.value <= rules_.on_screw_m)) {
    return TouchRefusal{Kind::kOffTheScrew, axis.entry_m.value, rules_.on_screw_m};
  }
  if (!(axis.angle_rad.value <= rules_.on_screw_rad)) {
    return TouchRefusal{Kind::kAcrossTheScrew, 0.0, 0.0, axis.angle_rad.value, rules_.on_screw_rad};
  }
  if (!(axis.entry_m.sd <= rules_.most_entry_sd_m)) {
    return TouchRefusal{Kind::kEntryUnsure, axis.entry_m.sd, rules_.most_entry_sd_m};
  }
  if (!(axis.angle_rad.sd <= rules_.most_angle_sd_rad)) {
    return TouchRefusal{Kind::kAngleUnsure, 0.0, 0.0, axis.angle_rad.sd, rules_.most_angle_sd_rad};
  }
  return std::nullopt;
}

bool Placing::must_confirm(int redone) { return redone > 0 && !std::exchange(confirming_, true); }

std::optional<nav::OtherEntry> Placing::other_entry(const LevelState& level, std::size_t screw) {
  const nav::ScrewPlan& plan = level.plan.screws[screw];
  const nav::SurfaceIndex& bone = level.plan.model->surface();
  const auto driven = nav::cylinder_along(wire_->axis.line, plan, bone);
  nav::OtherEntryRules rules;
  rules.from_hole_m = rules_.drill_diameter_m;
  const auto found =
      redo_ ? nav::other_entry(plan, driven ? driven->entry : wire_->axis.line.point, bone, rules)
            : std::nullopt;
  no_other_entry_ = !found;
  return found;
}

StepState Placing::state() const { return WireSoFar{wire_ ? &*wire_ : nullptr, no_other_entry_}; }

}  // namespace orthonav::engine
