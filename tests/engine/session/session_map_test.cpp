#include <gmock/gmock.h>

#include "engine/holograms/scene_builder.h"
#include "engine/session/session.h"
#include "tests/support/said.h"
#include "tests/support/scripted_operation.h"

namespace orthonav::engine::session_map_test {
namespace {

using test::guide_at;
using test::notice_of;
using test::pointer_at;
using test::ScriptedOperation;
using test::step_of;
using enum ClickerAction;

constexpr Vec3 kLeftEntry{0.015, 0.020, 0.0};

/// What a wearer sees beside the status line.
std::vector<HologramKind> holograms(const Guidance& guidance) {
  SceneBuilder builder;
  builder.update(guidance);
  ShownFrame shown;
  builder.write_shown(guidance, shown);
  std::vector<HologramKind> kinds;
  for (const ShownHologram& hologram : shown.holograms) {
    kinds.push_back(hologram.kind);
  }
  return kinds;
}

TEST(MapMoved, TheFirstEpochIsNoMove) {
  ScriptedOperation s;
  s.map_epoch = 7;
  s.registers_first_level();
  EXPECT_EQ(s.pair().step, Step::kVerify);
}

TEST(MapMoved, DropsWhatWasStroked) {
  ScriptedOperation s;
  s.tracker().pointer = pointer_at({0, 0.02, 0});
  s.says("start");
  s.strokes(5);
  s.says("save");
  s.says("delete");  // a region that would fade disappears too
  ASSERT_EQ(s.pair().regions.size(), 1u);
  ++s.map_epoch;
  const Guidance& g = s.pair();
  EXPECT_EQ(step_of(g), "digitize L4");
  EXPECT_EQ(notice_of(g), Notice::kMapMoved);
  EXPECT_TRUE(g.regions.empty());
  EXPECT_EQ(g.dropped, nullptr);
  EXPECT_THAT(holograms(g), ::testing::IsEmpty());
  EXPECT_TRUE(s.strokes(5).regions.size() == 1u) << "and goes on";
}

TEST(MapMoved, AStrokeUnderWayDoesNotGoOn) {
  ScriptedOperation s;
  s.tracker().pointer = pointer_at({0, 0.02, 0});
  s.says("start");
  s.does({kPress});
  s.pairs(3);
  ++s.map_epoch;
  EXPECT_TRUE(s.pairs(3).regions.empty()) << "half of its samples would lie in another map";
}

TEST(MapMoved, TakesARegistrationBackInEveryStep) {
  for (const Step step : {Step::kVerify, Step::kTouchLandmark, Step::kGuide}) {
    ScriptedOperation s;
    s.registers_first_level();
    if (step != Step::kVerify) {
      s.accepts();
    }
    if (step == Step::kGuide) {
      s.says("next");
      s.tracker().guide = guide_at(kLeftEntry, 0.1);
    }
    ASSERT_EQ(s.pairs(3).step, step);
    ASSERT_THAT(holograms(s.pair()), ::testing::Not(::testing::IsEmpty()));
    ++s.map_epoch;
    const Guidance& g = s.pair();
    EXPECT_EQ(g.step, Step::kDigitize);
    EXPECT_FALSE(g.levels[0].registration.has_value());
    EXPECT_FALSE(g.levels[0].accepted);
    EXPECT_THAT(holograms(g), ::testing::IsEmpty());
  }
}

TEST(MapMoved, AcceptSaidBeforeButHeardAfterIsRefused) {
  ScriptedOperation s;
  s.registers_first_level();
  s.pairs(3);
  s.hears_at(s.now(), "accept");
  ++s.map_epoch;
  const Guidance& g = s.pair();
  EXPECT_EQ(g.step, Step::kDigitize);
  EXPECT_FALSE(g.levels[0].accepted);
}

TEST(MapMoved, KeepsTheScrewsThatAreInAndGuidesTheOthersAfterANewRegistration) {
  ScriptedOperation s;
  s.accepts_first_level();
  s.says("next");
  s.says("next");
  ++s.map_epoch;
  s.pair();
  EXPECT_TRUE(s.session().levels()[0].screws[0].done);
  s.strokes(5);
  s.says("save");
  s.does({kDoubleClick});
  s.accepts();
  EXPECT_EQ(step_of(s.says("next")), "guide L4 right");
}

/// Both levels guided, and two heads of the left rod touched.
void comes_to_the_rod(ScriptedOperation& s) {
  s.accepts_first_level();
  for (int i = 0; i < 3; ++i) {
    s.says("next");
  }
  s.strokes(5);
  s.says("save");
  s.does({kDoubleClick});
  s.accepts();
  for (int i = 0; i < 3; ++i) {
    s.says("next");
  }
  s.touches({0, 0.02, 0});
  s.touches({0, 0.02, 0.03});
}

TEST(MapMoved, AFinishedLevelStaysInTheReportAndIsShownNoMore) {
  ScriptedOperation s;
  comes_to_the_rod(s);
  ASSERT_EQ(step_of(s.pair()), "rod left");
  ++s.map_epoch;
  const Guidance& g = s.pair();
  EXPECT_TRUE(g.levels[0].accepted);
  EXPECT_TRUE(g.levels[0].registration.has_value());
  EXPECT_FALSE(g.levels[0].usable());
  EXPECT_THAT(holograms(g), ::testing::IsEmpty());
}

TEST(MapMoved, TheRodUnderWayBeginsAnew) {
  ScriptedOperation s;
  comes_to_the_rod(s);
  ++s.map_epoch;
  const Guidance& g = s.pair();
  EXPECT_EQ(step_of(g), "rod left");
  EXPECT_EQ(notice_of(g), Notice::kMapMoved);
  EXPECT_TRUE(g.rods[0].heads.empty());
  s.touches({0, 0.02, 0});
  EXPECT_EQ(s.touches({0, 0.02, 0.03}).rods[0].heads.size(), 2u);
}

TEST(MapMoved, AFinishedRodIsShownNoMore) {
  ScriptedOperation s;
  comes_to_the_rod(s);
  s.says("done");
  ++s.map_epoch;
  const Guidance& g = s.pair();
  EXPECT_EQ(g.rods[0].heads.size(), 2u);
  EXPECT_TRUE(g.rods[0].rod.has_value());
  EXPECT_THAT(holograms(g), ::testing::IsEmpty());
  s.touches({0.02, 0.02, 0});
  EXPECT_THAT(holograms(s.touches({0.02, 0.02, 0.03})), ::testing::ElementsAre(HologramKind::kRod))
      << "only the new one";
}

}  // namespace
}  // namespace orthonav::engine::session_map_test
