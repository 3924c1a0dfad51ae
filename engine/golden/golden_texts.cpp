#include "engine/golden/golden_texts.h"

#include <array>

#include "base/angle.h"
#include "engine/golden/golden_stage.h"
#include "engine/holograms/shapes/hologram_numbers.h"
#include "engine/session/text/wording.h"

namespace orthonav::engine {
namespace {

using golden::kEntry;
using golden::planned_point;
using render::Label;
using render::Scene;

/// The last text that is added to a scene.
template <class Add>
TextKind last_of(const char* name, const Add& add) {
  Scene scene;
  add(scene);
  return {name, scene.texts.back()};
}

/// A row under the cross: angle, offset, depth.
TextKind row(const char* name, std::size_t row, Worst worst, Label label) {
  TargetCross target;
  target.viewer = golden::surgeon();
  CrossNumbers numbers;
  numbers.sizes = nav::ScrewSizes{{34, nav::Certainty::kSure}, {12, nav::Certainty::kBound}};
  numbers.depth = nav::ShownDepth{nav::DepthTo::kPastTarget, 12, nav::Certainty::kSure};
  numbers.worst = worst;
  Scene scene;
  add_cross_numbers(scene, target, numbers, {label, label, label});
  return {name, scene.texts[row]};
}

TextKind tool_lost(const char* name, Label label) {
  TargetCross target;
  target.viewer = golden::surgeon();
  target.lost = true;
  return last_of(name, [&](Scene& s) { add_target_cross(s, target, label); });
}

TextKind word(const char* name, const char* text, bool larger, Label label) {
  TargetCross target;
  target.viewer = golden::surgeon();
  return last_of(name, [&](Scene& s) {
    add_cross_word(s, target, text, look::colours().poor, larger, label);
  });
}

TextKind entry(const char* name, bool done, Label label) {
  return last_of(name, [&](Scene& s) {
    add_entry(s, {kEntry, golden::kNormal, "L4 left", done, LabelSide::kRight}, label);
  });
}

TextKind check(const char* name, double distance_m, bool within, Label label) {
  return last_of(name, [&](Scene& s) {
    add_check_point(s, kEntry, distance_text(distance_m), within, label);
  });
}

/// The length is written after all bends.
TextKind rod(const char* name, bool bend, Label label) {
  const std::array<render::Float3, 2> heads = {golden::kEntry, golden::kOtherEntry};
  const std::array<RodBendMark, 1> bends = {{{kEntry, 6.2 * kRadiansPerDegree, 0.0271}}};
  RodHologram hologram;
  hologram.heads = heads;
  hologram.bends = bends;
  hologram.length_m = 0.0820;
  Scene scene;
  add_rod(scene, hologram, label);
  return {name, bend ? scene.texts.front() : scene.texts.back()};
}

TextKind numbers(const char* name, double translation_m, Label label) {
  return last_of(name, [&](Scene& s) {
    TargetCross target;
    target.viewer = golden::surgeon();
    const golden::NumberSds sds{translation_m, 10.0 * translation_m};
    add_numbers(s, target, golden::numbers_of(golden::guided(2.0, 0.001, 0.0), sds), false, label);
  });
}

TextKind status(const char* name, const char* text, Label label) {
  return last_of(name, [&](Scene& s) { add_status_line(s, text, {}, label); });
}

}  // namespace

std::vector<TextKind> text_kinds() {
  return {
      entry("entry", false, 301),
      entry("entry, done", true, 302),
      row("angle", 0, Worst::kNothing, 601),
      row("angle, worst", 0, Worst::kAngle, 602),
      row("offset, bound", 1, Worst::kCertainty, 1306),
      row("depth", 2, Worst::kNothing, 901),
      row("depth, past target", 2, Worst::kDepth, 902),
      last_of("distance of the tip", [](Scene& s) { add_tip_distance(s, kEntry, 0.063, 903); }),
      tool_lost("tool lost", 703),
      word("stop", "stop", true, 1305),
      word("may break through", "may break through medially", false, 1304),
      numbers("every number", 0.0003, 1301),
      numbers("every number, unsure", 0.003, 1302),
      rod("rod, bend", true, 1001),
      rod("rod, length", false, 1002),
      check("check point, within", 0.0004, true, 1201),
      check("check point, off", 0.0031, false, 1202),
      status("status line", "verify L4", 1101),
      status("status line, danger", "guide L4 left | guide lost", 1102),
      last_of("head not located", [](Scene& s) { add_notice(s, words::kHeadNotLocated, 1103); })};
}

namespace golden {

/// Each kind of text on each of the four grounds.
void add_text_scenes(std::vector<GoldenScene>& scenes) {
  constexpr std::size_t kRows = 10;
  constexpr float kLastRow = 10.2f;
  constexpr float kRow = 0.0225f;  // these are tangents
  constexpr float kColumn = 0.19f;
  GoldenScene golden = start_wide(
      "texts", "every kind of text, legible on wound, drape, bone and glove", surgeon_views());
  golden.views.resize(1);
  golden.behind = GoldenBehind::kFourGrounds;
  const std::vector<TextKind> kinds = text_kinds();
  for (const float left : {-0.385f, 0.01f}) {
    for (const float top : {0.235f, -0.021f}) {
      for (std::size_t i = 0; i < kinds.size(); ++i) {
        // The last is the longest and has a row of its own.
        const bool last = i + 1 == kinds.size();
        const auto column = static_cast<float>(last ? 0 : i / kRows);
        const float row = last ? kLastRow : static_cast<float>(i % kRows);
        render::TextItem& item = golden.scene.texts.emplace_back();
        item = kinds[i].text;
        item.place = render::TextPlace::kView;
        item.position = {0.5f * (left + column * kColumn), 0.5f * (top - row * kRow), -0.5f};
        item.align = render::TextAlign::kLeft;
        item.offset_right = item.offset_up = 0;
      }
    }
  }
  scenes.push_back(std::move(golden));
}

}  // namespace golden
}  // namespace orthonav::engine
