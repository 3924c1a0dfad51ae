#include "tools/preview/panel.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string_view>

#include "base/printed.h"
#include "engine/session/text/wording.h"
#include "tools/preview/error_sources.h"
#include "tools/preview/panel_parts.h"
#include "tools/preview/screw_panel.h"

namespace orthonav::preview {
namespace {

void draw_step(const Moment& moment) {
  for (std::size_t i = 0; i < engine::kStepCount; ++i) {
    const auto step = static_cast<engine::Step>(i);
    const bool now = step == moment.at.step;
    // Two rows: nine names are too long for one.
    if (i != 0 && i != 5) {
      ImGui::SameLine(0.0f, 6.0f);
    }
    ImGui::TextColored(now ? kGood : kDim, "%s%s", now ? "\u25b6 " : "",
                       std::string(engine::name_of(step)).c_str());
  }
  text(engine::step_text(moment.at));
  wrapped_text(kDim, moment.detail.empty() ? "-" : moment.detail);
}

void draw_tools(const Moment& moment) {
  for (const ToolSeen& tool : moment.tools) {
    const bool measured = tool.status == PoseStatus::kMeasured;
    const bool lost = tool.status == PoseStatus::kLost;
    ImGui::TextColored(measured ? kGood : lost ? kBad : kFair, "\u25cf");
    ImGui::SameLine();
    text(tool.name);
    ImGui::SameLine(120.0f);
    ImGui::TextColored(kDim, "%s", measured ? "measured" : lost ? "lost" : "predicted");
    if (lost) {
      continue;
    }
    ImGui::SameLine(230.0f);
    ImGui::Text("\u03c3 %.2f mm", 1e3 * tool.translation_sigma_m);
  }
  const bool located = moment.world_from_rig.status != PoseStatus::kLost;
  ImGui::TextColored(located ? kGood : kBad, "\u25cf");
  ImGui::SameLine();
  text("head");
  ImGui::SameLine(120.0f);
  ImGui::TextColored(kDim, "%s", located ? "located" : "lost");
}

void timing(const char* name, double ms) {
  text(name);
  ImGui::SameLine(230.0f);
  ImGui::Text("%7.1f ms", ms);
}

void draw_timings(const Moment& moment, const PanelFacts& facts) {
  timing("camera pair", moment.camera_ms);
  timing("tracking and session", moment.tracking_ms);
  timing("picture behind", facts.background_ms);
  timing("holograms", facts.holograms_ms);
  text("window");
  ImGui::SameLine(230.0f);
  ImGui::Text("%7.1f /s", facts.pictures_a_second);
  ImGui::TextColored(kDim, "%s", facts.device.c_str());
}

void draw_time(PreviewModel& model, const Moment& moment, const PanelFacts& facts) {
  bool paused = model.gate().paused();
  if (ImGui::Button(paused ? "\u25b6 go on" : "\u2016 pause", {86.0f, 0.0f})) {
    model.pause(!paused);
  }
  ImGui::SameLine();
  if (ImGui::Button("\u2190")) {
    model.step_back();
  }
  ImGui::SameLine();
  if (ImGui::Button("\u2192")) {
    model.step_on();
  }
  ImGui::SameLine();
  if (ImGui::Button("newest")) {
    model.live();
  }
  ImGui::SameLine();
  const double speed = model.gate().speed();
  if (speed > 0.0) {
    ImGui::Text("%g\u00d7", speed);
  } else {
    text("fastest");
  }
  const auto newest = model.timeline().newest();
  const std::int64_t last = std::max({facts.pairs, newest ? newest->pair : 1, std::int64_t{1}});
  const std::int64_t first = 1;
  std::int64_t pair = moment.pair;
  ImGui::SetNextItemWidth(-1.0f);
  if (ImGui::SliderScalar("##pair", ImGuiDataType_S64, &pair, &first, &last, "frame %lld")) {
    model.scrub_to(pair);
  }
  const auto begun = model.timeline().at(1);
  const long tenths = begun ? std::lround(10.0 * seconds(moment.time - begun->time)) : 0;
  ImGui::TextColored(model.looks_back() ? kFair : kDim, "%s%02ld:%02ld.%ld",
                     model.looks_back() ? "looking back, " : "", tenths / 600, tenths / 10 % 60,
                     tenths % 10);
}

void draw_holograms(PreviewModel& model) {
  HologramFilter& filter = model.look().holograms;
  for (unsigned number = 1; number <= kLastHologram; ++number) {
    bool shown = filter.shows(number);
    const std::string name = printed("H%u %s", number, engine::kHolograms[number - 1].name);
    if (number % 2 == 0) {
      ImGui::SameLine(190.0f);
    }
    if (ImGui::Checkbox(name.c_str(), &shown)) {
      filter.show(number, shown);
    }
  }
}

void draw_error_sources(PreviewModel& model, const PanelFacts& facts,
                        sim::ErrorModel& error_model) {
  if (ImGui::Button("start again")) {
    model.wishes().restart = true;
  }
  ImGui::SameLine();
  if (ImGui::Button("perfect")) {
    error_model = sim::ErrorModel::perfect();
  }
  ImGui::SameLine();
  if (ImGui::Button("usual")) {
    error_model = sim::ErrorModel();
  }
  ImGui::TextColored(kDim, "take effect when started again");
  std::string_view group;
  for (const ErrorSource& source : error_sources()) {
    if (group != source.group) {
      ImGui::TextColored(kDim, "%s", source.group);
    }
    group = source.group;
    double shown = error_model.*source.value * source.scale;
    char format[32];
    const std::string_view unit = source.unit;
    std::snprintf(format, sizeof format, "%%.3g%s%s%s", unit.starts_with("°") ? "" : " ",
                  unit.starts_with('%') ? "%" : "", source.unit);
    const bool changed = error_model.*source.value != facts.running->*source.value;
    ImGui::PushID(&source);
    ImGui::SetNextItemWidth(130.0f);
    if (ImGui::SliderScalar("##value", ImGuiDataType_Double, &shown, &source.least, &source.most,
                            format, ImGuiSliderFlags_AlwaysClamp)) {
      error_model.*source.value = shown / source.scale;
    }
    ImGui::SameLine();
    ImGui::TextColored(changed ? kFair : ImGui::GetStyle().Colors[ImGuiCol_Text], "%s",
                       source.name);
    ImGui::PopID();
  }
}

void draw_buttons(PreviewModel& model, const PanelFacts& facts) {
  bool orbits = model.look().camera.orbits();
  if (ImGui::Checkbox("orbit", &orbits)) {
    model.orbit(orbits);
  }
  ImGui::SameLine(80.0f);
  ImGui::Checkbox("tools", &model.look().tools);
  ImGui::SameLine(155.0f);
  bool muted = model.keyboard().muted();
  if (ImGui::Checkbox("mute", &muted)) {
    model.mute(muted);
  }
  ImGui::SameLine(230.0f);
  if (ImGui::Button("screenshot")) {
    model.wishes().screenshot = true;
  }
  ImGui::SameLine();
  if (ImGui::Button(facts.video ? "stop" : "video")) {
    model.wishes().video = true;
  }
  // An empty line as well, so that nothing jumps when there is something to say.
  wrapped_text(kFair, facts.note);
}

void draw_help_lines() {
  for (const KeyBinding& binding : key_bindings()) {
    // Digits show and hide what the panel lists; one line for all of them.
    if (binding.command == Command::kHologram && binding.hologram != 1) {
      continue;
    }
    const bool holograms = binding.command == Command::kHologram;
    const std::string what(holograms ? "holograms H1 - H12" : binding.what);
    help_line(holograms ? "1 - 9, f10 - f12" : std::string(binding.name),
              binding.command == Command::kSay ? "say \"" + what + "\"" : what);
  }
  help_line("drag, wheel", "orbiting: turn (with shift: move), nearer; else larger");
}

void draw_moment(PreviewModel& model, const Moment& moment, const PanelFacts& facts) {
  draw_time(model, moment, facts);
  draw_buttons(model, facts);
  if (ImGui::CollapsingHeader("workflow", ImGuiTreeNodeFlags_DefaultOpen)) {
    draw_step(moment);
  }
  if (ImGui::CollapsingHeader("planned screw")) {
    draw_screw([&model](const std::string& phrase) { model.say(phrase); });
  }
  if (ImGui::CollapsingHeader("tracking", ImGuiTreeNodeFlags_DefaultOpen)) {
    draw_tools(moment);
  }
  if (ImGui::CollapsingHeader("holograms", ImGuiTreeNodeFlags_DefaultOpen)) {
    draw_holograms(model);
  }
  if (ImGui::CollapsingHeader("timings")) {
    draw_timings(moment, facts);
  }
}

void draw_content(PreviewModel& model, const PanelFacts& facts, sim::ErrorModel& error_model) {
  text(facts.headset);
  ImGui::SameLine(std::max(230.0f, ImGui::CalcTextSize(facts.headset.c_str()).x + 24.0f));
  ImGui::TextColored(kDim, "h: keys");
  if (facts.moment) {
    draw_moment(model, *facts.moment, facts);
  } else {
    ImGui::TextColored(kFair, "waiting for the first pair");
  }
  if (facts.running && ImGui::CollapsingHeader("error sources")) {
    draw_error_sources(model, facts, error_model);
  }
}

}  // namespace

void draw_panel(PreviewModel& model, const PanelFacts& facts, sim::ErrorModel& error_model) {
  if (model.help()) {
    draw_help_window(draw_help_lines);
  }
  if (model.panel()) {
    draw_panel_window([&] { draw_content(model, facts, error_model); });
  }
}

}  // namespace orthonav::preview
