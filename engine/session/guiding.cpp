#include "engine/session/guiding.h"

#include <algorithm>
#include <limits>

namespace orthonav::engine {
namespace {

/// Withdrawn by more than this, the tool is no longer at depth; a hand at rest moves less.
constexpr double kWithdrawn_m = 0.001;
/// A tip farther off the planned axis is not at the screw. Depth along the axis alone would count a
/// tool laid down beside the patient.
constexpr double kOffTheScrew_m = 0.015;
/// A tool that is turned farther from the plan is not aimed at it: 30°.
constexpr double kAway_rad = 0.52;

}  // namespace

void Guiding::select_open_screw(const LevelState& level) {
  screw_ = level.open_screw().value_or(0);
  forget_guidance();
}

void Guiding::begin_level() {
  screw_ = 0;
  forget_guidance();
}

void Guiding::forget_guidance() {
  at_depth_.reset();
  numbers_.forget();
  clearance_.forget();
  drill_.forget();
  path_.forget();
}

std::optional<ToolGuidance> Guiding::guide(const LevelState& level, const ToolWatch& watch,
                                           const nav::ToolGeometry& tool, Timestamp now,
                                           Timestamp display_time, Duration stale_after) {
  if (!watch.measured_now()) {
    lose_measurement();
  }
  if (!level.registration || !watch.fresh(now, stale_after)) {
    return std::nullopt;
  }
  // Between two measurements the overlay is predicted, as long as the tracker itself still follows
  // the tool; the number is not.
  const nav::TrackedPose at_display = watch.at(display_time, stale_after);
  if (watch.newest().status == PoseStatus::kLost || at_display.status == PoseStatus::kLost) {
    return std::nullopt;
  }
  const auto& world_from_vertebra = level.registration->world_from_vertebra;
  const nav::ScrewPlan& plan = level.plan.screws[screw_];
  const auto against_plan = [&](const Transform<World, Marker>& pose) {
    return nav::guide(world_from_vertebra, plan, pose * tool.tip_in_marker,
                      (pose * tool.axis_in_marker).v);
  };
  ToolGuidance guidance{std::nullopt, against_plan(at_display.value),
                        watch.last_measured().value_or(Timestamp{})};
  if (!watch.measured_now()) {
    return guidance;
  }
  guidance.measured = against_plan(watch.newest().value);
  take_measurement(guidance, level, watch.newest(), tool);
  remember_depth(guidance, *guidance.measured, watch.newest());
  return guidance;
}

ToolInVertebra Guiding::in_bone(const LevelState& level, const nav::TrackedPose& pose,
                                const nav::ToolGeometry& tool) const {
  ToolErrors errors = errors_;
  errors.walked_sd_m = level.walked_sd_m(pose.time);
  return in_vertebra(*level.registration, pose, tool, errors);
}

void Guiding::lose_measurement() {
  numbers_.forget();
  clearance_.forget();
  drill_.not_measured();
}

void Guiding::take_measurement(ToolGuidance& guidance, const LevelState& level,
                               const nav::TrackedPose& pose, const nav::ToolGeometry& tool) {
  const nav::ScrewPlan& plan = level.plan.screws[screw_];
  const nav::ScrewGuidance& measured = *guidance.measured;
  const ToolInVertebra there = in_bone(level, pose, tool);
  const nav::PoseUncertainty* uncertainty = there.uncertainty ? &*there.uncertainty : nullptr;
  const auto deviation = nav::anatomical_deviation(plan, there.axis, uncertainty);
  if (deviation) {
    guidance.numbers = numbers_.write(*deviation);
  }
  const auto on_bone = level.plan.model->surface().nearest(there.axis.point.v);
  if (measured.tip_off_axis_m <= kOffTheScrew_m) {
    path_.add(plan, there.axis, uncertainty);
  }
  drill_.measured({pose.time, there.axis.point.v,
                   on_bone ? on_bone->distance_m : std::numeric_limits<double>::infinity(),
                   measured.tip_off_axis_m, measured.angle_rad, measured.depth_m,
                   deviation ? deviation->depth_m.sd : std::numeric_limits<double>::infinity(),
                   measured.to_target_m, tool.stop_m});
}

void Guiding::remember_depth(const ToolGuidance& guidance, const nav::ScrewGuidance& measured,
                             const nav::TrackedPose& pose) {
  if (!(measured.tip_off_axis_m <= kOffTheScrew_m)) {
    return;
  }
  const double depth_m = measured.depth_m;
  if (!at_depth_ || depth_m >= deepest_m_ - kWithdrawn_m) {
    deepest_m_ = at_depth_ ? std::max(deepest_m_, depth_m) : depth_m;
    at_depth_ = guidance;
    pose_at_depth_ = pose;
  }
}

std::optional<nav::ScrewClearance> Guiding::clearance_along(const LevelState& level,
                                                            const nav::TrackedPose& pose,
                                                            const nav::ToolGeometry& tool) const {
  if (!level.registration) {
    return std::nullopt;
  }
  const nav::ScrewPlan& plan = level.plan.screws[screw_];
  const ToolInVertebra there =
      in_vertebra(*level.registration, pose, tool, {level.walked_sd_m(pose.time)});
  const nav::Axis<Vertebra>& axis = there.axis;
  const Vec3 planned = plan.target - plan.entry;
  const Vec3 off_m = (axis.point - plan.entry).cross(planned.normalized());
  if (!(off_m.norm() <= kOffTheScrew_m) ||
      !(angle_between_rad(planned, axis.direction) <= kAway_rad)) {
    return std::nullopt;
  }
  const nav::SurfaceIndex& bone = level.plan.model->surface();
  const auto screw = nav::cylinder_along(axis, plan, bone);
  if (!screw) {
    return std::nullopt;
  }
  return nav::screw_clearance(bone, *screw, there.uncertainty ? &*there.uncertainty : nullptr);
}

void Guiding::add_clearance(ToolGuidance& guidance, const LevelState& level,
                            const nav::TrackedPose& pose, const nav::ToolGeometry& tool) {
  guidance.clearance = clearance_along(level, pose, tool);
  if (guidance.clearance) {
    guidance.shown_clearance =
        clearance_.write(*guidance.clearance, level.plan.screws[screw_].side);
  } else {
    clearance_.forget();
  }
}

std::optional<nav::ScrewClearance> Guiding::clearance_at_depth(
    const LevelState& level, const nav::ToolGeometry& tool) const {
  return at_depth_ ? clearance_along(level, pose_at_depth_, tool) : std::nullopt;
}

StepState Guiding::state(const LevelState& level) const {
  if (!level.registration) {
    return {};
  }
  return RegistrationFigures{level.registration->rmse_m, level.predicted[screw_].worst_m(), true,
                             level.registration_only(), level.replanned(screw_)};
}

}  // namespace orthonav::engine
