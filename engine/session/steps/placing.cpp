#include "engine/session/steps/placing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <span>
#include <utility>

#include "base/angle.h"
#include "base/printed.h"
#include "base/translation.h"
#include "engine/session/guide_checks.h"
#include "engine/session/steps/guiding.h"
#include "engine/session/steps/replanning.h"
#include "engine/session/text/wording.h"

namespace orthonav::engine {
namespace {

/// A sleeve that turns more than this while it is pressed (root mean square) is not at rest.
constexpr double kMaxTurn_rad = 1.0 * kRadiansPerDegree;
/// If it is farther off the plan, the sleeve is not over this screw's wire.
constexpr double kOnScrew_m = 0.015;
constexpr double kOnScrew_rad = 30.0 * kRadiansPerDegree;
/// A measurement with a larger SD can hardly tell within from beyond the limit: three quarters of
/// it.
constexpr double kMaxAngleSd_rad = 1.5 * kRadiansPerDegree;

}  // namespace

Placing::Placing(const SessionOptions& options)
    : rules_(options.placed), redo_(options.steps.redo) {
  recent_.reserve(2 * kMostRecent);
}

void Placing::collect(SessionState& work) {
  const WatchedTools& tools = work.tools;
  const nav::TrackedPose& pose = tools.watch(tools.guide()).newest();
  const nav::ToolGeometry& guide = tools.geometry(tools.guide());
  if (pose.status != PoseStatus::kMeasured) {
    return work.touches.sleeve.lose();
  }
  work.touches.sleeve.add(
      {pose.value * guide.tip_in_marker, (pose.value * guide.axis_in_marker).v});
  if (recent_.size() == 2 * kMostRecent) {
    recent_.erase(recent_.begin(), recent_.begin() + kMostRecent);
  }
  recent_.push_back(pose.value);
}

void Placing::measure(SessionState& work, const Guiding& guiding, GuideChecks& checks,
                      bool reference_hidden, Timestamp time) {
  const ToolWatch& guide = work.tools.watch(work.tools.guide());
  std::optional<TouchRefusal> refusal;
  if (reference_hidden) {
    work.touches.sleeve.drop();
    refusal = TouchRefusal{TouchRefusal::Kind::kReferenceNotSeen};
  } else if (!guide.fresh(time, work.options.stale_after)) {
    work.touches.sleeve.drop();
    refusal = TouchRefusal{TouchRefusal::Kind::kGuideNotSeen};
  } else {
    refusal = take(work, guiding.screw(), checks.errors(work, time));
  }
  if (refusal) {
    return work.messages.say(TouchNotRecorded{TouchNotRecorded::What::kWire, *refusal}, time);
  }
  tell(work, guiding.screw(), time);
  if (spin_ && work.options.steps.axis) {
    checks.compare_axis(work, *spin_, time);
  }
}

std::optional<TouchRefusal> Placing::take(SessionState& work, std::size_t screw,
                                          const ToolErrors& guide_errors) {
  const LevelState& level = work.level();
  const nav::TrackedPose& pose = work.tools.watch(work.tools.guide()).last_measured_pose();
  const nav::ToolGeometry& guide = work.tools.geometry(work.tools.guide());
  const auto taken = work.touches.sleeve.take(work.options.max_touch_spread_m, kMaxTurn_rad);
  if (const auto* refusal = std::get_if<TouchRefusal>(&taken)) {
    return *refusal;
  }
  RestingAxis resting = std::get<RestingAxis>(taken);
  use_turning(guide, resting);
  // The axis is the sleeve's own, below.
  const auto now = in_vertebra(*level.registration, pose, guide,
                               {guide_errors.drift_sd_m, guide_errors.unshared_sd_m});
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
  // If the described axis is off, axis and tip circle the wire while the sleeve turns; their means
  // do not.
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
  if (!(axis.entry_m.value <= kOnScrew_m)) {
    return TouchRefusal{Kind::kOffTheScrew, axis.entry_m.value, kOnScrew_m};
  }
  if (!(axis.angle_rad.value <= kOnScrew_rad)) {
    return TouchRefusal{Kind::kAcrossTheScrew, 0.0, 0.0, axis.angle_rad.value, kOnScrew_rad};
  }
  if (!(axis.entry_m.sd <= rules_.most_entry_sd_m)) {
    return TouchRefusal{Kind::kEntryUnsure, axis.entry_m.sd, rules_.most_entry_sd_m};
  }
  if (!(axis.angle_rad.sd <= kMaxAngleSd_rad)) {
    return TouchRefusal{Kind::kAngleUnsure, 0.0, 0.0, axis.angle_rad.sd, kMaxAngleSd_rad};
  }
  return std::nullopt;
}

void Placing::tell(SessionState& work, std::size_t screw, Timestamp time) const {
  work.observer->wire_measured(time, work.level(), screw, *wire_);
}

void Placing::keep(SessionState& work, std::size_t screw, Timestamp time) {
  wire_->kept = true;
  tell(work, screw, time);
}

void Placing::judge_again(SessionState& work, std::size_t screw, Timestamp time) {
  put(nav::placed_axis(work.level().plan.screws[screw], measured_->sleeve, measured_->uncertainty,
                       measured_->errors));
  tell(work, screw, time);
}

std::optional<FollowUpEvent> Placing::judge_redo(SessionState& work, Guiding& guiding,
                                                 Timestamp time) {
  LevelState& level = work.level();
  const std::size_t screw = guiding.screw();
  const auto refuse = [&](Message why) {
    work.messages.say(std::move(why), time);
    return std::nullopt;
  };
  if (!wire_) {
    return refuse(NothingToDelete{NothingToDelete::What::kWire});
  }
  if (!undecided()) {
    return refuse(NotPossibleNow{Event::kSayDelete});
  }
  if (must_confirm(level.screws[screw].redone)) {
    return refuse(ConfirmRedo{level.screws[screw].redone});
  }
  const auto other = other_entry(level, screw);
  if (!other) {
    return Event::kNoOtherEntry;
  }
  put_other_entry(level, screw, other->entry);
  ++level.screws[screw].redone;
  guiding.forget_guidance();
  work.observer->screw_redone(time, level, screw, *other);
  return FollowUpEvent{Event::kScrewRedone,
                       ScrewRedone{other->from_hole_m, other->clearance.clearance_m}};
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

void Placing::write(Step step, Guidance& out) const {
  out.wire = step == Step::kMeasureWire && wire_ ? &*wire_ : nullptr;
}

StepState Placing::state() const { return WireSoFar{wire_ ? &*wire_ : nullptr, no_other_entry_}; }

// Its records.

void log_wire(LogJson& json, std::size_t screw, const PlacedWire& wire) {
  json["screw"] = screw;
  json["wire"] = json_of(wire);
  json["within"] = wire.within();
}

void read_wire(const JsonNode& node, ScrewState& screw) {
  screw.wire = {true, wire_from(node.child("wire"))};
}

LogJson json_of(const PlacedWire& wire) {
  LogJson json = {{"point_m", json_of(wire.axis.line.point.v)},
                  {"direction", json_of(wire.axis.line.direction)}};
  json["angle_rad"] = LogJson{wire.axis.angle_rad.value, wire.axis.angle_rad.sd};
  json["entry_m"] = LogJson{wire.axis.entry_m.value, wire.axis.entry_m.sd};
  json["point_covariance_m2"] = wire.axis.point_covariance_m2;
  json["direction_covariance_rad2"] = wire.axis.direction_covariance_rad2;
  json["pairs"] = wire.pairs;
  json["angle_limit_rad"] = wire.angle_limit_rad;
  json["entry_limit_m"] = wire.entry_limit_m;
  json["kept"] = wire.kept;
  return json;
}

PlacedWire wire_from(const JsonNode& node) {
  PlacedWire wire;
  const auto [angle_rad, angle_sd_rad] = array_from<2>(node, "angle_rad");
  const auto [entry_m, entry_sd_m] = array_from<2>(node, "entry_m");
  wire.axis = {{{node.vec3("point_m")}, node.vec3("direction")},
               {angle_rad, angle_sd_rad},
               {entry_m, entry_sd_m},
               array_from<9>(node, "point_covariance_m2"),
               array_from<9>(node, "direction_covariance_rad2")};
  wire.pairs = count_from(node, "pairs");
  wire.angle_limit_rad = node.number("angle_limit_rad");
  wire.entry_limit_m = node.number("entry_limit_m");
  wire.kept = node.flag_or("kept", false);
  return wire;
}

// Its words.

void write_wire(PartedText text, const WireSoFar& state, std::string_view separator) {
  std::string& out = text.out;
  if (state.wire == nullptr) {
    text.begin(Importance::kNext, separator);
    out += translated("sleeve over wire, turn, click");
    return;
  }
  const PlacedWire& wire = *state.wire;
  if (wire.within()) {
    text.begin(Importance::kNext, separator);
    out += translated("say go to next");
    return;
  }
  text.begin(wire.kept ? Importance::kMessage : Importance::kDanger, separator);
  if (!wire.angle_within()) {
    append_beside_limit(out, translated("angle %.1f°, limit %.1f°"),
                        degrees(wire.axis.angle_rad.value), degrees(wire.angle_limit_rad));
  }
  if (!wire.entry_within()) {
    out += wire.angle_within() ? "" : "; ";
    append_beside_limit(out, translated("entry %.1f mm, limit %.1f mm"),
                        wire.axis.entry_m.value * 1e3, wire.entry_limit_m * 1e3);
  }
  text.begin(Importance::kNext, ": ");
  if (wire.kept) {
    out += translated("kept, say go to next");
  } else {
    out += translated(state.no_other_entry ? words::kNoOtherEntry : words::kKeepOrRedo);
  }
}

void write(PartedText text, const WireUndecided& /*m*/) {
  std::string& out = text.out;
  text.begin(Importance::kNext);
  out.append(translated(words::kNotYet)).append(" ").append(translated(words::kKeepOrRedo));
}

void write(PartedText text, const NoOtherEntry& /*m*/) {
  std::string& out = text.out;
  text.begin(Importance::kNext);
  out += translated(words::kNoOtherEntry);
}

void write(PartedText text, const ConfirmRedo& m) {
  std::string& out = text.out;
  text.begin(Importance::kNext);
  append_printed(
      out,
      m.redone == 1 ? translated("redone once already") : translated("redone %d times already"),
      m.redone);
  out.append(": ").append(translated("say delete last again to redo it, accept result to keep it"));
}

void write(PartedText text, const ScrewRedone& m) {
  std::string& out = text.out;
  text.begin(Importance::kMessage);
  append_printed(out, translated("new entry %s from the hole, clearance %s"),
                 format_mm(m.from_hole_m).c_str(), format_mm(m.clearance_m).c_str());
  text.begin(Importance::kNext, ": ");
  out += translated("take the wire out and touch the landmark");
}

}  // namespace orthonav::engine
