#include "tools/preview/planning/plan_panel.h"

#include <algorithm>
#include <array>

#include "engine/case/screw_breach.h"
#include "engine/session/steps/replanning.h"
#include "nav/guidance/changed_screw.h"
#include "nav/planning/pedicle_screws.h"
#include "tools/preview/panel_parts.h"
#include "tools/preview/planning/plan_scene.h"
#include "tools/preview/screw_panel.h"

namespace orthonav::preview {
namespace {

std::string size_of(const nav::ScrewPlan& screw) {
  std::string out;
  engine::append_size(out, 2.0 * screw.radius_m, nav::screw_length_m(screw));
  return out;
}

/// One place for a screw of a level, to be selected.
void place_button(PlanModel& model, const engine::ScrewPlace& place) {
  const engine::CaseLevel& level = model.editor().subject().levels[place.level];
  const auto screw =
      std::find_if(level.screws.begin(), level.screws.end(),
                   [&](const nav::ScrewPlan& planned) { return planned.side == place.side; });
  const std::string shown = std::string(name_of(place.side)) + "  " +
                            (screw == level.screws.end() ? "none" : size_of(*screw)) + "##" +
                            level.label + name_of(place.side);
  if (ImGui::RadioButton(shown.c_str(), model.editor().place() == place)) {
    model.select(place);
  }
}

void draw_places(PlanModel& model) {
  const auto& levels = model.editor().subject().levels;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    text(levels[i].label);
    ImGui::SameLine(46.0f);
    place_button(model, {i, nav::Side::kLeft});
    ImGui::SameLine(210.0f);
    place_button(model, {i, nav::Side::kRight});
  }
}

void draw_clearance(const PlanModel& model) {
  const engine::PlanEditor& editor = model.editor();
  const nav::ScrewPlan* screw = editor.screw();
  if (!screw) {
    return wrapped_text(kDim, "no screw is planned here");
  }
  const bool listed = screw->radius_m > 0.0 &&
                      editor.sizes().has(2.0 * screw->radius_m, nav::screw_length_m(*screw));
  text(size_of(*screw));
  if (!listed) {
    ImGui::SameLine();
    ImGui::TextColored(kFair, "not in the list of screws");
  }
  const auto& least = editor.clearance();
  if (!least) {
    return wrapped_text(kFair, "no diameter is stated: clearance not measured");
  }
  const double clearance_m = least->clearance_m;
  const double wanted_m = nav::PlanningRules{}.wanted_clearance_m;
  const ImVec4& colour = clearance_m < 0.0 ? kBad : clearance_m < wanted_m ? kFair : kGood;
  ImGui::TextColored(colour, "clearance %s mm, grade %s",
                     engine::clearance_text(clearance_m).c_str(),
                     nav::name_of(nav::grade_of(clearance_m)));
  ImGui::TextColored(kDim, "nearest %s, %.0f mm past the entry",
                     nav::direction_of(*least, screw->side), 1e3 * least->arc_length_m);
  if (!(clearance_m < 0.0)) {
    return;
  }
  wrapped_text(kBad,
               screw->accepted_breach.empty()
                   ? std::string("breaks through the cortex: no operation takes it, unless you "
                                 "type \"breach\" and the reason")
                   : "breaks through the cortex; accepted: " + screw->accepted_breach);
}

void command_button(PlanModel& model, const char* phrase) {
  if (ImGui::Button(phrase)) {
    model.say(phrase);
  }
  ImGui::SameLine(0.0f, 4.0f);
}

void draw_commands(PlanModel& model) {
  for (const char* phrase : {"auto", "delete", "redo"}) {
    command_button(model, phrase);
  }
  if (ImGui::Button("save")) {
    model.wishes().save = true;
  }
  ImGui::SameLine(0.0f, 4.0f);
  if (ImGui::Button("screenshot")) {
    model.wishes().screenshot = true;
  }
  wrapped_text(model.editor().unsaved() ? kFair : kDim,
               model.editor().unsaved() ? "not saved yet" : "as loaded or saved");
  if (model.editor().unsaved()) {
    ImGui::SameLine(210.0f);
    if (ImGui::SmallButton("quit without saving")) {
      model.discard();
    }
  }
  // An empty line as well, so that nothing jumps when there is something to say.
  wrapped_text(kFair, model.note().empty() ? " " : model.note());
}

void draw_help_lines() {
  for (const PlanKeyBinding& binding : plan_key_bindings()) {
    help_line(std::string(binding.name), std::string(binding.what));
  }
  help_line("drag", "entry, target, or the screw, in a slice; in space: turn");
  help_line("", "beside them: the scan wider to the right, brighter upward");
  help_line("wheel", "larger; across the screw: 1 mm along it; in space: nearer");
}

void draw_content(PlanModel& model, const PlanFacts& facts) {
  text("plan of " + model.editor().subject().name);
  ImGui::SameLine(230.0f);
  ImGui::TextColored(kDim, "h: keys");
  draw_places(model);
  ImGui::Separator();
  draw_clearance(model);
  ImGui::Separator();
  draw_screw([&model](const std::string& phrase) { model.say(phrase); });
  draw_commands(model);
  wrapped_text(kDim, facts.scan.empty() ? "no scan: --volume FILE lays it behind the slices"
                                        : "scan " + facts.scan);
  ImGui::TextColored(kDim, "%s", facts.device.c_str());
}

}  // namespace

void draw_plan_panel(PlanModel& model, const PlanFacts& facts) {
  if (model.help()) {
    draw_help_window(draw_help_lines);
  }
  if (model.panel()) {
    draw_panel_window([&] { draw_content(model, facts); });
  }
}

}  // namespace orthonav::preview
