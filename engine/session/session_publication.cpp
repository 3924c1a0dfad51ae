#include <cmath>

#include "engine/session/numbers_wording.h"
#include "engine/session/session.h"
#include "engine/session/wording.h"

namespace orthonav::engine {
namespace {

RegistrationFigures figures(const LevelState& level) {
  return {level.registration->rmse_m, nav::worst_m(level.predicted), false,
          level.registration_only()};
}

}  // namespace

void Session::publish(const StereoFrame& frame, Timestamp display_time) {
  Guidance& out = guidance_;
  out.frame_time = frame.time;
  out.display_time = display_time;
  const auto tool = tool_of_step();
  out.pose_time = tool ? tools_.watch(*tool).last_measured().value_or(Timestamp{}) : frame.time;
  out.step = step_;
  out.levels = levels_;
  out.level = level_;
  out.stale_after = options_.stale_after;
  out.fade = options_.fade;
  out.blank = stalled_.has_value();
  out.tools = tools_.sights();
  out.anchor = tools_.tracker().anchor();
  if (frame.world_from_rig) {
    out.head = out.anchor ? out.anchor->world_from_anchored.inverse() * *frame.world_from_rig
                          : *frame.world_from_rig;
  }
  publish_steps(frame.time, display_time);
  publish_status();
}

void Session::publish_steps(Timestamp now, Timestamp display_time) {
  Guidance& out = guidance_;
  out.regions = digitizing_.regions();
  out.dropped = digitizing_.dropped(display_time, options_.fade);
  out.residuals_m = {};
  out.unstroked = {};
  out.to_check = {};
  if (step_ == Step::kVerify) {
    if (!stalled_) {
      verifying_.show(display_time);
    }
    out.residuals_m = verifying_.residuals_m();
    out.unstroked = verifying_.unstroked();
    out.to_check = verifying_.to_check();
  }
  out.screw = guiding_.screw();
  out.twin = guiding_.twin();
  out.tool.reset();
  const bool hidden = in_use_.guidance_hidden() || stalled_;
  if (step_ == Step::kGuide && !hidden) {
    guiding_.know_errors(guide_errors(now));
    out.tool =
        guiding_.guide(level(), tools_.watch(tools_.guide()), tools_.geometry(tools_.guide()), now,
                       display_time, options_.stale_after);
    if (out.tool && out.tool->measured && options_.live_clearance) {
      guiding_.add_clearance(*out.tool, level(), tools_.watch(tools_.guide()).newest(),
                             tools_.geometry(tools_.guide()));
    }
  }
  if (step_ == Step::kGuide && hidden) {
    guiding_.lose_measurement();
  }
  out.wire = step_ == Step::kPlaced && placing_.wire() ? &*placing_.wire() : nullptr;
  out.drill = step_ == Step::kGuide ? guiding_.drill() : nav::DrillView{};
  out.rods = rod_templating_.rods();
  out.rods_moved_away = rod_templating_.moved_away();
}

/// The cameras shift what they see at one place alike. The guide's tag is seen elsewhere than the
/// pointer's was, by some 0.1 m at 0.45 m, and the head has turned since: so much of their error is
/// taken not to be shared. Estimate.
ToolErrors Session::guide_errors(Timestamp now) const {
  constexpr double kElsewhere = 0.3;
  const double cameras_m = level().registration ? level().registration->common.cameras_m : 0.0;
  return {level().walked_sd_m(now),
          std::hypot(tip_check_.difference_sd_m(tools_.tag_size_difference_sd()),
                     kElsewhere * cameras_m),
          axis_check_.sd_rad()};
}

StepOnDisplay Session::step_on_display() const {
  switch (step_) {
    case Step::kSetup:
    case Step::kDone:
      return {step_, {}, {}};
    case Step::kDigitize:
    case Step::kVerify:
    case Step::kAccepted:
      return {step_, level().plan.label, {}};
    case Step::kGuide:
    case Step::kPlaced:
      return {step_, level().plan.label, level().plan.screws[guiding_.screw()].side};
    case Step::kRod:
      return {step_, {}, rod_templating_.current().side};
  }
  return {};
}

void Session::publish_status() {
  messages_.expire(guidance_.frame_time);
  StatusLine& line = guidance_.status;
  line.at = step_on_display();
  line.stalled = stalled_;
  line.tool = {};
  line.tool_lost = false;
  line.tag_size_off.reset();
  if (const auto tool = tool_of_step()) {
    line.tool = tools_.geometry(*tool).name;
    line.tool_lost = in_use_.lost();
    line.tag_size_off = tools_.tag_size_off(*tool);
  }
  if (const auto reference = hidden_reference()) {
    line.tool = tools_.geometry(*reference).name;
    line.tool_lost = true;
  }
  publish_instruments();
  replanning_.show(guidance_.display_time);
  line.message = messages_.message();
  line.heard = messages_.heard();
  line.state = state_of_step();
  line.saved = saved(guidance_.frame_time);
  if (step_ == Step::kVerify) {
    constexpr std::size_t kLongLine = 512;
    shown_.clear();
    shown_.reserve(kLongLine);
    append_status(shown_, line);
  }
}

/// What is in hand that the step has no use for, and a depth stop that is set too deep.
void Session::publish_instruments() {
  StatusLine& line = guidance_.status;
  const bool on_a_level = step_ != Step::kSetup && step_ != Step::kDone;
  in_hand_.look(tools_, step_, tool_of_step(), on_a_level ? &level() : nullptr,
                guidance_.frame_time);
  const auto unused = in_hand_.unused();
  line.unused_tool = unused ? std::string_view(tools_.geometry(*unused).name) : std::string_view();
  line.stop_past_target_m.reset();
  if (stop_too_deep(guidance_.drill)) {
    line.stop_past_target_m = guidance_.drill.stop_past_target_m;
  }
}

/// The first of them, while none is seen in a step that needs one.
std::optional<std::size_t> Session::hidden_reference() const {
  if (!guidance_.anchor || !reference_hidden_ || step_ == Step::kSetup || step_ == Step::kDone) {
    return std::nullopt;
  }
  return tools_.first_reference();
}

StepState Session::state_of_step() const {
  switch (step_) {
    case Step::kDigitize:
      return digitizing_.state();
    case Step::kVerify:
    case Step::kAccepted:
      if (!level().registration) {
        return {};
      }
      if (by_touch(Step::kVerify)) {
        return verifying_.state(level());
      }
      if (by_touch(Step::kAccepted)) {
        return LandmarkSoFar{figures(level()), level().landmark.has_value(), landmarking_.last(),
                             &tip_check_, &axis_check_};
      }
      return figures(level());
    case Step::kGuide:
      return guiding_.state(level());
    case Step::kPlaced:
      return placing_.state();
    case Step::kRod:
      return rod_templating_.state();
    case Step::kSetup:
    case Step::kDone:
      return {};
  }
  return {};
}

}  // namespace orthonav::engine
