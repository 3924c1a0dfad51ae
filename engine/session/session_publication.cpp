#include <array>
#include <cstdio>

#include "engine/session/session.h"

namespace orthonav::engine {

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
  out.blank = false;
  out.tools = tools_.sights();
  if (frame.world_from_rig) {
    out.head = frame.world_from_rig;
  }
  publish_steps(frame.time, display_time);
  write_step_text();
  write_detail();
}

void Session::publish_steps(Timestamp now, Timestamp display_time) {
  Guidance& out = guidance_;
  out.regions = digitizing_.regions();
  out.dropped = digitizing_.dropped(display_time, options_.fade);
  out.residuals_m = {};
  out.unstroked = {};
  out.to_check = {};
  if (step_ == Step::kVerify) {
    verifying_.show(display_time);
    out.residuals_m = verifying_.residuals_m();
    out.unstroked = verifying_.unstroked();
    out.to_check = verifying_.to_check();
  }
  out.screw = guiding_.screw();
  out.twin = guiding_.twin();
  out.tool.reset();
  if (step_ == Step::kGuide && !in_use_.guidance_hidden()) {
    out.tool =
        guiding_.guide(level(), tools_.watch(tools_.guide()), tools_.geometry(tools_.guide()), now,
                       display_time, options_.stale_after);
  }
  out.rods = rod_templating_.rods();
  out.rods_moved_away = rod_templating_.moved_away();
}

void Session::write_step_text() {
  std::array<char, 160> text{};
  const std::string& label = level().plan.label;
  const char* name = name_of(step_).data();
  switch (step_) {
    case Step::kSetup:
    case Step::kDone:
      guidance_.step_text = name;
      break;
    case Step::kDigitize:
    case Step::kVerify:
    case Step::kAccepted:
      std::snprintf(text.data(), text.size(), "%s %s", name, label.c_str());
      guidance_.step_text = text.data();
      break;
    case Step::kGuide:
      std::snprintf(text.data(), text.size(), "%s %s %s", name, label.c_str(),
                    name_of(level().plan.screws[guiding_.screw()].side));
      guidance_.step_text = text.data();
      break;
    case Step::kRod:
      std::snprintf(text.data(), text.size(), "%s %s", name,
                    name_of(rod_templating_.current().side));
      guidance_.step_text = text.data();
      break;
  }
}

/// The loss of the tool comes first: no message may cover it.
void Session::write_detail() {
  messages_.expire(guidance_.frame_time);
  guidance_.heard = messages_.heard();
  std::string& out = guidance_.detail;
  out.clear();
  const auto tool = tool_of_step();
  if (tool && in_use_.lost()) {
    out += tools_.geometry(*tool).name;
    out += " lost";
  } else if (tool) {
    tools_.append_tag_size_warning(out, *tool);
  }
  const bool taken = !out.empty();
  if (!messages_.message().empty()) {
    out += taken ? "; " : "";
    out += messages_.message();
  } else if (!taken) {
    append_state_of_step(out);
  } else if (checks_by_touch()) {
    // What is to be touched counts on beside a warning that stays.
    out += "; ";
    verifying_.append_checks(out, level());
  }
}

void Session::append_state_of_step(std::string& out) const {
  switch (step_) {
    case Step::kDigitize:
      digitizing_.append_state(out);
      break;
    case Step::kVerify:
    case Step::kAccepted:
      if (!level().registration) {
        break;
      }
      if (checks_by_touch()) {
        verifying_.append_state(out, level());
      } else {
        append_registration(out, level());
      }
      break;
    case Step::kGuide:
      guiding_.append_state(out, level());
      break;
    case Step::kRod:
      rod_templating_.append_state(out);
      break;
    case Step::kSetup:
    case Step::kDone:
      break;
  }
}

}  // namespace orthonav::engine
