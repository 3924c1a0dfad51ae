#include <gmock/gmock.h>

#include "engine/holograms/scene_builder.h"
#include "engine/holograms/shapes/hologram_numbers.h"
#include "engine/session/work_watch.h"
#include "tests/support/scripted_operation.h"
#include "tests/tools/language/pseudo_language.h"

namespace orthonav::engine::translated_holograms_test {
namespace {

using test::english_left;
using test::guide_at;
using test::ScriptedOperation;
using ::testing::HasSubstr;

std::string all_text(const render::Scene& scene) {
  std::string all;
  for (const render::TextItem& item : scene.texts) {
    for (const render::TextRun& run : item.runs) {
      all += run.text;
    }
    all += '\n';
  }
  return all;
}

/// The commands that are heard in this operation.
constexpr const char* kHeard = "start|save|accept result|accept|go to next|next";

/// What the display draws, and what a headset is told, in no language but the wearer's.
void expect_translated(SceneBuilder& builder, const Guidance& guidance) {
  builder.update(guidance);
  render::Scene scene;
  builder.write_scene(guidance, scene);
  EXPECT_EQ(english_left(all_text(scene), kHeard), "") << all_text(scene);
  engine::ShownFrame frame;
  builder.write_shown(guidance, frame);
  ASSERT_TRUE(frame.status);
  EXPECT_EQ(english_left(frame.status->text, kHeard), "") << frame.status->text;
  for (const engine::ShownHologram& shown : frame.holograms) {
    EXPECT_EQ(english_left(shown.text, kHeard), "") << shown.text;
  }
  hide_tool_guidance(scene);
  EXPECT_EQ(english_left(all_text(scene), kHeard), "") << all_text(scene);
}

TEST(TranslatedHolograms, SayNothingInEnglishInAWholeOperation) {
  const test::PseudoLanguage pseudo;
  SceneBuilder builder;
  ScriptedOperation s;
  expect_translated(builder, s.pair());
  expect_translated(builder, s.says("start"));
  expect_translated(builder, s.strokes(20));
  expect_translated(builder, s.says("accept"));
  ScriptedOperation touched({"L4"}, {}, Verification::kByTouch);
  expect_translated(builder, touched.registers_first_level());
  expect_translated(builder, touched.checks_by_touch());
  expect_translated(builder, touched.accepts());
  expect_translated(builder, touched.touches_landmark());
  ScriptedOperation guiding;
  expect_translated(builder, guiding.accepts_first_level());
  guiding.tracker().guide = guide_at({0.017, 0.021, 0.0}, 0.05);
  expect_translated(builder, guiding.says("next"));
  expect_translated(builder, guiding.pairs(40));
  guiding.tracker().guide.reset();
  expect_translated(builder, guiding.pairs(40));
  ScriptedOperation rod;
  rod.finishes_every_screw();
  rod.touches({0.02, 0.03, 0.00});
  expect_translated(builder, rod.touches({0.02, 0.03, 0.04}));
  expect_translated(builder, rod.touches({0.05, 0.03, 0.08}));
}

TEST(TranslatedHolograms, SayWhyNothingIsShown) {
  const test::PseudoLanguage pseudo;
  render::Scene scene;
  render::Scene left;
  write_head_lost(scene, left);
  EXPECT_EQ(all_text(left), "[]\n");
  write_notice_alone(scene, stalled_text(Part::kTracker), left);
  EXPECT_EQ(all_text(left), "[]\n");
}

TEST(TranslatedHolograms, SayTheNumbersAndTheClearance) {
  const test::PseudoLanguage pseudo;
  const WearersLanguage language;
  render::Scene scene;
  const TargetCross cross;
  add_numbers(scene, cross, {{12, 14, false}, {8, 3, true}, {-21, 5, true}, {-4, 5, true}}, true,
              1301);
  CrossNumbers numbers;
  numbers.sizes.emplace();
  numbers.depth = nav::ShownDepth{nav::DepthTo::kPastTarget, 12, nav::Certainty::kBound};
  add_cross_numbers(scene, cross, numbers, {601, 1306, 901});
  add_clearance(scene, cross, {24, 11, "medial"}, 1303);
  add_clearance(scene, cross, {-4, -9, "tip"}, 1303);
  EXPECT_THAT(all_text(scene), HasSubstr("1.2 ± 1.4 mm []"));
  EXPECT_EQ(english_left(all_text(scene)), "") << all_text(scene);
}

TEST(TranslatedHolograms, AreEnglishWithoutATranslation) {
  ScriptedOperation s;
  SceneBuilder builder;
  const Guidance& g = s.pair();
  builder.update(g);
  render::Scene scene;
  builder.write_scene(g, scene);
  EXPECT_THAT(all_text(scene), HasSubstr("setup"));
  EXPECT_NE(english_left(all_text(scene)), "") << "the control";
}

}  // namespace
}  // namespace orthonav::engine::translated_holograms_test
