#include "engine/session/steps/guiding.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <nlohmann/json.hpp>

#include "base/printed.h"
#include "base/translation.h"
#include "engine/session/calibration_in_use.h"
#include "engine/session/guide_checks.h"
#include "engine/session/steps/placing.h"
#include "engine/session/steps/rod_templating.h"
#include "engine/session/text/wording.h"

namespace orthonav::engine {
namespace {

/// Withdrawn by more than this, the tool is no longer at depth; a hand at rest moves less.
constexpr double kWithdrawn_m = 0.001;
/// A tool tilted farther from the plan is not aimed at it: 30°.
constexpr double kAway_rad = 0.52;

/// The event after a screw is done.
Event after_screw(const SessionState& work) {
  const auto finished = [](const LevelState& level) { return level.finished(); };
  if (!finished(work.level())) {
    return Event::kAnotherScrew;
  }
  if (!std::all_of(work.state.levels.begin(), work.state.levels.end(), finished)) {
    return Event::kAnotherLevel;
  }
  return any_rod_planned(work.state.levels) ? Event::kNoScrewLeft : Event::kNoRodPlanned;
}

/// Of a screw in the hole of a drill that goes astray from the tool.
nav::PoseUncertainty with_astray(const nav::PoseUncertainty& of_tool,
                                 const nav::ScrewCylinder& screw, const DrillSkiving& astray) {
  nav::CommonErrors skived;
  skived.tip_m = astray.start_m;
  return nav::with_turn(nav::with_common(of_tool, skived), screw.entry, screw.direction,
                        astray.direction_rad);
}

}  // namespace

void Guiding::select_open_screw(const LevelState& level) {
  screw_ = level.open_screw().value_or(0);
  forget_guidance();
}

void Guiding::begin_level() {
  screw_ = 0;
  forget_guidance();
}

Event Guiding::finish_screw(SessionState& work, const Placing& placing, Timestamp time) const {
  LevelState& level = work.level();
  const auto& at_depth = approach_.at_depth;
  ScrewState& screw = level.screws[screw_];
  screw.done = true;
  screw.done_at = time;
  screw.at_depth = at_depth ? at_depth->measured : std::nullopt;
  screw.clearance_at_depth =
      at_depth ? clearance_along(level, approach_.pose_at_depth,
                                 work.tools.geometry(work.tools.guide()), work.options.astray)
               : std::nullopt;
  screw.executed = approach_.path.mean();
  if (work.step == Step::kMeasureWire) {
    screw.wire = {true, placing.wire()};
  }
  work.observer->screw_done(time, level, screw_, at_depth ? &*at_depth : nullptr);
  work.observer->calibration_found(time, calibration_in_use(work.tools.tracker()));
  return after_screw(work);
}

void Guiding::write(const SessionState& work, const GuideChecks& checks, bool hidden,
                    Guidance& out) {
  out.screw = screw_;
  out.asked = asked_;
  out.tool.reset();
  out.drill = {};
  out.was_set = false;
  if (work.step != Step::kGuide) {
    return;
  }
  if (hidden) {
    lose_measurement();
  } else {
    errors_ = checks.errors(work, out.frame_time);
    out.tool = guide(work, out.frame_time, out.display_time);
  }
  out.drill = drill();
  out.was_set = approach_.was_set;
}

std::optional<ToolGuidance> Guiding::guide(const SessionState& work, Timestamp now,
                                           Timestamp display_time) {
  const LevelState& level = work.level();
  const ToolWatch& watch = work.tools.watch(work.tools.guide());
  const nav::ToolGeometry& tool = work.tools.geometry(work.tools.guide());
  const Duration stale_after = work.options.stale_after;
  if (!watch.measured_now()) {
    lose_measurement();
  }
  if (!level.registration || !watch.fresh(now, stale_after)) {
    return std::nullopt;
  }
  // Between two measurements the overlay is predicted, as long as the tracker still follows the
  // tool; the numbers are not.
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
  if (work.options.live_clearance) {
    add_clearance(guidance, work, watch.newest(), tool);
  }
  return guidance;
}

ToolInVertebra Guiding::in_bone(const LevelState& level, const nav::TrackedPose& pose,
                                const nav::ToolGeometry& tool) const {
  ToolErrors errors = errors_;
  errors.drift_sd_m = level.drift_sd_m(pose.time);
  return in_vertebra(*level.registration, pose, tool, errors);
}

void Guiding::lose_measurement() {
  approach_.numbers.forget();
  approach_.sizes.forget();
  approach_.depth.forget();
  approach_.clearance.forget();
  approach_.drill.not_measured();
}

void Guiding::take_measurement(ToolGuidance& guidance, const LevelState& level,
                               const nav::TrackedPose& pose, const nav::ToolGeometry& tool) {
  const nav::ScrewPlan& plan = level.plan.screws[screw_];
  const nav::ScrewGuidance& measured = *guidance.measured;
  const ToolInVertebra there = in_bone(level, pose, tool);
  const nav::PoseUncertainty* uncertainty = there.uncertainty ? &*there.uncertainty : nullptr;
  const auto deviation = nav::anatomical_deviation(plan, there.axis, uncertainty);
  if (deviation) {
    guidance.numbers = approach_.numbers.write(*deviation);
  }
  constexpr double kUnknown = std::numeric_limits<double>::infinity();
  const double angle_sd_rad =
      deviation ? std::max(deviation->aim_cranial_rad.sd, deviation->aim_medial_rad.sd) : kUnknown;
  const double offset_sd_m =
      deviation ? std::max(deviation->tip_cranial_m.sd, deviation->tip_medial_m.sd) : kUnknown;
  guidance.sizes = approach_.sizes.write({measured.angle_rad, angle_sd_rad},
                                         {measured.tip_off_axis_m, offset_sd_m});
  const double depth_sd_m = deviation ? deviation->depth_m.sd : kUnknown;
  guidance.depth = approach_.depth.write({measured.depth_m, depth_sd_m}, measured.to_target_m);
  const auto on_bone = level.plan.model->surface().nearest(there.axis.point.v);
  approach_.watch_drill({pose.time, there.axis.point.v, on_bone ? on_bone->distance_m : kUnknown,
                         measured.tip_off_axis_m, measured.angle_rad, measured.depth_m, depth_sd_m,
                         measured.to_target_m, tool.stop_m});
  if (measured.tip_off_axis_m <= kOffTheScrew_m) {
    approach_.path.add(plan, there.axis, uncertainty);
  }
}

void Guiding::Approach::watch_drill(const nav::DrillReading& reading) {
  using enum nav::DrillPhase;
  const bool away = drill.view().phase == kAway;
  drill.measured(reading);
  drilled = drilled || drill.view().phase == kDrilling;
  was_set = was_set || drill.view().phase != kAway;
  if (away && !drilled && drill.view().phase == kSet) {
    path.forget();
    at_depth.reset();
  }
}

void Guiding::remember_depth(const ToolGuidance& guidance, const nav::ScrewGuidance& measured,
                             const nav::TrackedPose& pose) {
  if (!(measured.tip_off_axis_m <= kOffTheScrew_m)) {
    return;
  }
  const double depth_m = measured.depth_m;
  if (!approach_.at_depth || depth_m >= approach_.deepest_m - kWithdrawn_m) {
    approach_.deepest_m = approach_.at_depth ? std::max(approach_.deepest_m, depth_m) : depth_m;
    approach_.at_depth = guidance;
    approach_.pose_at_depth = pose;
  }
}

std::optional<nav::ScrewClearance> Guiding::clearance_along(const LevelState& level,
                                                            const nav::TrackedPose& pose,
                                                            const nav::ToolGeometry& tool,
                                                            const DrillSkiving& astray) const {
  if (!level.registration) {
    return std::nullopt;
  }
  const nav::ScrewPlan& plan = level.plan.screws[screw_];
  const ToolInVertebra there = in_bone(level, pose, tool);
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
  if (!there.uncertainty) {
    return nav::screw_clearance(bone, *screw, nullptr);
  }
  const nav::PoseUncertainty of_drill = with_astray(*there.uncertainty, *screw, astray);
  return nav::screw_clearance(bone, *screw, &of_drill);
}

void Guiding::add_clearance(ToolGuidance& guidance, const SessionState& work,
                            const nav::TrackedPose& pose, const nav::ToolGeometry& tool) {
  guidance.clearance = clearance_along(work.level(), pose, tool, work.options.astray);
  if (guidance.clearance) {
    guidance.shown_clearance =
        approach_.clearance.write(*guidance.clearance, work.level().plan.screws[screw_].side);
  } else {
    approach_.clearance.forget();
  }
}

// Its records.

namespace {

LogJson executed_json(const nav::ExecutedTrajectory& executed) {
  LogJson json = {{"point_m", json_of(executed.axis.point.v)},
                  {"direction", json_of(executed.axis.direction)}};
  json["depth_m"] = executed.depth_m;
  json["pairs"] = executed.pairs;
  if (executed.point_covariance_m2) {
    json["point_covariance_m2"] = *executed.point_covariance_m2;
  }
  if (executed.direction_covariance_rad2) {
    json["direction_covariance_rad2"] = *executed.direction_covariance_rad2;
  }
  return json;
}

LogJson clearance_json(const nav::ScrewClearance& clearance) {
  const nav::Clearance& least = clearance.least;
  LogJson json = {{"clearance_m", least.clearance_m},
                  {"arc_length_m", least.arc_length_m},
                  {"outward", json_of(least.outward)},
                  {"on_tip", least.on_tip},
                  {"place_m", json_of(least.place.v)}};
  if (clearance.spread) {
    json["lower_95_m"] = clearance.spread->lower_95_m;
    json["grade_probability"] = clearance.spread->grade_probability;
  }
  return json;
}

/// The tool against its screw: only the figures that a report has.
LogJson at_depth_json(const nav::ScrewGuidance& at_depth) {
  return {{"angle_rad", at_depth.angle_rad},
          {"tip_to_entry_m", at_depth.tip_to_entry_m},
          {"tip_off_axis_m", at_depth.tip_off_axis_m},
          {"depth_m", at_depth.depth_m}};
}

nav::ExecutedTrajectory executed_from(const JsonNode& node) {
  nav::ExecutedTrajectory executed;
  executed.axis = {{node.vec3("point_m")}, node.vec3("direction")};
  executed.depth_m = node.number("depth_m");
  executed.pairs = count_from(node, "pairs");
  if (node.has("point_covariance_m2")) {
    executed.point_covariance_m2 = array_from<9>(node, "point_covariance_m2");
  }
  if (node.has("direction_covariance_rad2")) {
    executed.direction_covariance_rad2 = array_from<9>(node, "direction_covariance_rad2");
  }
  return executed;
}

nav::ScrewClearance clearance_from(const JsonNode& node) {
  nav::ScrewClearance clearance;
  clearance.least = {node.number("clearance_m"),
                     node.number("arc_length_m"),
                     node.vec3("outward"),
                     node.flag_or("on_tip", false),
                     {node.vec3("place_m")}};
  if (node.has("lower_95_m")) {
    clearance.spread = nav::ClearanceSpread{
        node.number("lower_95_m"), array_from<nav::kPedicleGrades>(node, "grade_probability")};
  }
  return clearance;
}

nav::ScrewGuidance at_depth_from(const JsonNode& node) {
  nav::ScrewGuidance out;
  out.angle_rad = node.number("angle_rad");
  out.tip_to_entry_m = node.number("tip_to_entry_m");
  out.tip_off_axis_m = node.number("tip_off_axis_m");
  out.depth_m = node.number("depth_m");
  return out;
}

}  // namespace

void log_screw(LogJson& json, const LevelState& level, std::size_t screw,
               const ToolGuidance* at_depth) {
  json["screw"] = screw;
  json["side"] = name_of(level.plan.screws[screw].side);
  const ScrewState& done = level.screws[screw];
  if (at_depth != nullptr && done.at_depth) {
    json["at_depth"] = at_depth_json(*done.at_depth);
    json["at_depth"]["pose_time_ns"] = at_depth->pose_time.time_since_epoch().count();
  }
  if (done.executed) {
    json["executed"] = executed_json(*done.executed);
  }
  if (done.clearance_at_depth) {
    json["clearance"] = clearance_json(*done.clearance_at_depth);
  }
  json["wire_asked"] = done.wire.asked;
  if (done.wire.measured) {
    json["wire"] = json_of(*done.wire.measured);
  }
}

void read_screw(const JsonNode& node, Timestamp time, ScrewState& screw) {
  screw.done = true;
  screw.done_at = time;
  screw.at_depth.reset();
  if (node.has("at_depth")) {
    screw.at_depth = at_depth_from(node.child("at_depth"));
  }
  screw.executed.reset();
  screw.clearance_at_depth.reset();
  screw.wire = {node.flag_or("wire_asked", false), std::nullopt};
  if (node.has("executed")) {
    screw.executed = executed_from(node.child("executed"));
  }
  if (node.has("clearance")) {
    screw.clearance_at_depth = clearance_from(node.child("clearance"));
  }
  if (node.has("wire")) {
    screw.wire.measured = wire_from(node.child("wire"));
  }
}

// Its words.

namespace {

bool is_angle(NumberRow row) {
  return row == NumberRow::kAimCranial || row == NumberRow::kAimMedial;
}

std::string_view direction_of(NumberRow row, int tenths) {
  const bool along_spine = row == NumberRow::kTipCranial || row == NumberRow::kAimCranial;
  if (along_spine) {
    return tenths > 0 ? translated("cranial") : translated("caudal");
  }
  return tenths > 0 ? translated("medial") : translated("lateral");
}

void append_tenths(std::string& out, int tenths) { append_printed(out, "%.1f", 0.1 * tenths); }

/// Nothing for a number that is sure.
void append_sd(std::string& out, bool sure, std::optional<int> sd_tenths) {
  if (sure) {
    return;
  }
  out += " ± ";
  if (sd_tenths) {
    append_tenths(out, *sd_tenths);
  } else {
    out += "--";
  }
}

void append_single(std::string& out, int tenths, nav::Certainty certainty, const char* bound,
                   const char* unit) {
  out += certainty == nav::Certainty::kBound ? bound : "";
  append_tenths(out, tenths);
  out += unit;
  out += certainty == nav::Certainty::kUnknown ? "?" : "";
}

/// Where a screw breaks through, by nav::direction_of.
const char* adverb_of(std::string_view towards) {
  constexpr std::array<std::array<const char*, 2>, 7> kAdverbs = {
      {{"tip", translatable("at its tip")},
       {"medial", translatable("medially")},
       {"lateral", translatable("laterally")},
       {"cranial", translatable("cranially")},
       {"caudal", translatable("caudally")},
       {translatable("anterior"), translatable("anteriorly")},
       {translatable("posterior"), translatable("posteriorly")}}};
  for (const auto& [direction, adverb] : kAdverbs) {
    if (towards == direction) {
      return translated(adverb);
    }
  }
  return "--";
}

}  // namespace

const nav::ShownNumber& number_of(const nav::ScrewNumbers& numbers, NumberRow row) {
  const std::array<const nav::ShownNumber*, kNumberRows> all = {
      &numbers.tip_cranial, &numbers.tip_medial, &numbers.aim_cranial, &numbers.aim_medial};
  return *all[static_cast<std::size_t>(row)];
}

void append_number(std::string& out, const nav::ScrewNumbers& numbers, NumberRow row) {
  const nav::ShownNumber& number = number_of(numbers, row);
  append_tenths(out, std::abs(number.tenths));
  append_sd(out, number.sure, number.sd_tenths);
  out += is_angle(row) ? "°" : " mm";
  if (number.tenths != 0) {
    out.append(" ").append(direction_of(row, number.tenths));
  }
}

void append_depth(std::string& out, const nav::ShownDepth& depth) {
  constexpr std::array<const char*, 3> kTo = {words::kToEntry, words::kToTarget,
                                              words::kPastTarget};
  const bool past = depth.to == nav::DepthTo::kPastTarget;
  append_single(out, depth.tenths, depth.certainty, past ? "≤ " : "≥ ", " mm");
  out.append(" ").append(translated(kTo[static_cast<std::size_t>(depth.to)]));
}

void append_angle(std::string& out, const nav::ShownSize& angle) {
  append_single(out, angle.tenths, angle.certainty, "≤ ", "°");
}

void append_offset(std::string& out, const nav::ShownSize& offset) {
  out.append(translated(words::kTip)).append(" ");
  append_single(out, offset.tenths, offset.certainty, "≤ ", " mm");
}

void append_rounded_mm(std::string& out, double length_m) {
  append_printed(out, "%.0f mm", length_m * 1e3);
}

void append_clearance(std::string& out, int tenths) {
  out += tenths < 0 ? "−" : "";
  append_tenths(out, std::abs(tenths));
  out += " mm";
}

void append_breach(std::string& out, const nav::ShownClearance& clearance) {
  append_printed(out,
                 clearance.least_tenths < 0 ? translated("breaks through %s")
                                            : translated("may break through %s"),
                 adverb_of(clearance.towards));
}

void append_clearance_line(std::string& out, const nav::ShownClearance& clearance,
                           bool registration_only) {
  out.append(translated(words::kClearance)).append(" ");
  append_clearance(out, clearance.least_tenths);
  if (clearance.may_break()) {
    out += ": ";
    append_breach(out, clearance);
    // A breach follows from the measured clearance; "may" refers to the bound.
    registration_only = registration_only && clearance.least_tenths >= 0;
  } else if (clearance.lower_95_tenths) {
    out.append(", ").append(translated(words::kAtLeast)).append(" ");
    append_clearance(out, *clearance.lower_95_tenths);
  }
  if (registration_only && clearance.lower_95_tenths) {
    append_registration_only(out);
  }
}

bool stop_too_deep(const nav::DrillView& drill) {
  constexpr double kLeastPast_m = 0.0001;
  return drill.stop_past_target_m && *drill.stop_past_target_m >= kLeastPast_m;
}

void append_stop_too_deep(std::string& out, double past_target_m) {
  append_printed(out, translated("stop lets the drill %.0f mm past the target"),
                 std::ceil(past_target_m * 1e3));
}

void append_drill(std::string& out, const nav::DrillView& drill) {
  out += drill.alarm == nav::DrillAlarm::kStop ? translated("stop") : translated("drilling");
  if (!drill.watched) {
    out.append(", ").append(translated("tool not seen"));
  }
}

bool all_sure(const nav::ScrewNumbers& numbers) {
  return numbers.tip_cranial.sure && numbers.tip_medial.sure && numbers.aim_cranial.sure &&
         numbers.aim_medial.sure;
}

}  // namespace orthonav::engine
