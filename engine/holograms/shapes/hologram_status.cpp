#include "engine/holograms/shapes/hologram_status.h"

#include <algorithm>
#include <array>

#include "engine/holograms/labels/status_rows.h"
#include "engine/holograms/shapes/hologram_parts.h"

namespace orthonav::engine {
namespace {

using render::Label;
using render::Scene;
using render::TextItem;

constexpr float kRowDistance_caps = 1.9f;
constexpr float kBeforeDot_caps = 1.2f;
constexpr std::string_view kBehindStep = " | ";

/// `row` counts downwards from the one with the step.
TextItem& add_row(Scene& scene, float row, Label label) {
  TextItem& item = scene.texts.emplace_back();
  item.label = label;
  item.place = render::TextPlace::kView;
  item.position = kStatusPlace;
  item.height_m = kStatusHeight_m;
  item.min_height_deg = kStatusMinHeight_deg;
  item.offset_up = -row * kRowDistance_caps;
  return item;
}

/// The shape shows it as well as the colour.
std::string_view dot_of(ToolState state) {
  constexpr std::array<std::string_view, 3> kDots = {"●", "◐", "○"};
  return kDots[static_cast<std::size_t>(state)];
}

render::Colour colour_of(ToolState state) {
  constexpr std::array<render::Colour HologramColours::*, 3> kColours = {
      &HologramColours::good, &HologramColours::fair, &HologramColours::poor};
  return look::colours().*kColours[static_cast<std::size_t>(state)];
}

/// Appends to a row that runs from left to right; its end so far is `pen`.
TextItem& add_piece(Scene& scene, float& pen, float width, Label label) {
  TextItem& item = add_row(scene, 0, label);
  item.align = render::TextAlign::kLeft;
  item.offset_right = pen;
  pen += width;
  return item;
}

void add_step_and_tools(Scene& scene, std::string_view step, std::span<const ToolDot> tools,
                        Label label) {
  const auto dots = static_cast<float>(tools.size());
  const float of_tools = dots * (kBeforeDot_caps + width_caps(dot_of(ToolState::kMeasured)));
  const float step_caps = std::min(width_caps(step), kStatusWidth_caps - of_tools);
  float pen = -0.5f * (step_caps + of_tools);
  append_cut(add_run(add_piece(scene, pen, step_caps, label), look::kSoftWhite), step, step_caps);
  for (const ToolDot& tool : tools) {
    pen += kBeforeDot_caps;
    const std::string_view dot = dot_of(tool.state);
    TextItem& mark = add_piece(scene, pen, width_caps(dot), label);
    mark.rim = colour_of(tool.state);
    add_run(mark, dot, look::kWhite);
  }
}

void add_detail(Scene& scene, std::string_view detail, const StatusParts* parts, Label label) {
  if (detail.empty()) {
    return;
  }
  StatusParts whole;
  whole.add({});
  const std::size_t first = scene.texts.size();
  for (std::size_t i = 0; i < kDetailRows; ++i) {
    add_run(add_row(scene, static_cast<float>(i + 1), label), "", look::kSoftWhite);
  }
  std::array<std::string*, kDetailRows> rows{};
  for (std::size_t i = 0; i < kDetailRows; ++i) {
    rows[i] = &scene.texts[first + i].runs.front().text;
  }
  fill_rows(detail, parts != nullptr ? *parts : whole, rows);
  while (scene.texts.back().runs.front().text.empty()) {
    scene.texts.pop_back();
  }
}

}  // namespace

void add_notice(Scene& scene, std::string_view text, Label label) {
  TextItem& item = add_row(scene, 0, label);
  item.offset_up = 2.0f;
  item.rim = look::colours().poor;
  add_run(item, text, look::kWhite);
}

void add_stop_row(Scene& scene, std::string_view text, Label label) {
  TextItem& item = add_row(scene, -1, label);
  item.rim = look::colours().poor;
  append_cut(add_run(item, look::kWhite), text, kStatusWidth_caps);
}

void add_next_act(Scene& scene, std::string_view text, std::size_t row, Label label) {
  if (!text.empty()) {
    append_cut(add_run(add_row(scene, static_cast<float>(row), label), look::kWhite), text,
               kStatusWidth_caps);
  }
}

void add_status_line(Scene& scene, const StatusWords& words, std::span<const ToolDot> tools,
                     Label label) {
  add_step_and_tools(scene, words.step, tools, label);
  add_detail(scene, words.detail, words.parts, label);
}

void add_status_line(Scene& scene, std::string_view text, std::span<const ToolDot> tools,
                     Label label) {
  const std::size_t end = text.find(kBehindStep);
  const bool step_alone = end == std::string_view::npos;
  add_status_line(
      scene,
      StatusWords{text.substr(0, end),
                  step_alone ? std::string_view{} : text.substr(end + kBehindStep.size()), nullptr},
      tools, label);
}

}  // namespace orthonav::engine
