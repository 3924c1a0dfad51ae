#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "engine/holograms/scene_builder.h"
#include "engine/session/session.h"
#include "engine/session/text/wording.h"
#include "tests/support/said.h"
#include "tests/support/scripted_operation.h"

namespace orthonav::engine::session_reference_test {
namespace {

using test::guide_at;
using test::notice_of;
using test::pointer_at;
using test::ScriptedOperation;
using test::step_of;

constexpr Vec3 kLeftEntry{0.015, 0.020, 0.0};

/// What a wearer sees of the patient.
ShownFrame shown(const Guidance& guidance) {
  SceneBuilder builder;
  builder.update(guidance);
  ShownFrame frame;
  builder.write_shown(guidance, frame);
  return frame;
}

/// Guiding the first screw with a tool on its entry and a reference in sight.
struct Guided : ScriptedOperation {
  Guided() {
    tracker().hang_on_reference();
    accepts_first_level();
    tracker().guide = guide_at(kLeftEntry, 0.1);
    says("next");
    pairs(3);
  }
};

std::string status(const Guidance& guidance) { return detail_text(guidance.status); }

TEST(PatientReference, HidesThePatientAndSaysSoOnceItIsStale) {
  Guided s;
  ASSERT_FALSE(shown(s.pair()).holograms.empty());
  s.tracker().reference_seen = false;
  EXPECT_FALSE(shown(s.pair()).holograms.empty()) << "33 ms old at the pair, 49 when it is shown";
  const Guidance& stale = s.pairs(4);
  EXPECT_TRUE(shown(stale).holograms.empty());
  EXPECT_THAT(status(stale), ::testing::HasSubstr("reference lost"));
  s.tracker().reference_seen = true;
  const Guidance& back = s.pair();
  EXPECT_FALSE(shown(back).holograms.empty());
  EXPECT_THAT(status(back), ::testing::Not(::testing::HasSubstr("reference")));
}

TEST(PatientReference, HidesThePatientInEveryStepThatShowsAny) {
  for (const Step step : {Step::kVerify, Step::kTouchLandmark, Step::kGuide, Step::kRod}) {
    ScriptedOperation s(step == Step::kRod ? std::vector<std::string>{"L4", "L5"}
                                           : std::vector<std::string>{"L4"});
    s.tracker().hang_on_reference();
    if (step == Step::kVerify) {
      s.registers_first_level();
    } else if (step == Step::kRod) {
      s.finishes_every_screw();
      s.touches({0.02, 0.03, 0.00});
    } else {
      s.accepts_first_level();
      if (step == Step::kGuide) {
        s.says("next");
      }
    }
    ASSERT_EQ(s.pair().step, step);
    ASSERT_FALSE(shown(s.pair()).holograms.empty()) << name_of(step);
    s.tracker().reference_seen = false;
    EXPECT_TRUE(shown(s.pairs(5)).holograms.empty()) << name_of(step);
    EXPECT_THAT(status(s.pair()), ::testing::HasSubstr("reference lost")) << name_of(step);
  }
}

TEST(PatientReference, TheMapMayMoveUnderIt) {
  Guided s;
  ++s.map_epoch;
  const Guidance& g = s.pairs(2);
  EXPECT_EQ(g.step, Step::kGuide);
  EXPECT_FALSE(shown(g).holograms.empty());
}

TEST(PatientReference, OneThatMovedTakesBackWhatHungOnIt) {
  Guided s;
  ++s.tracker().reference.moves;
  const Guidance& g = s.pair();
  EXPECT_EQ(step_of(g), "digitize L4");
  EXPECT_EQ(notice_of(g), Notice::kReferenceMoved);
  EXPECT_TRUE(shown(g).holograms.empty());
  EXPECT_EQ(s.pairs(200).step, Step::kDigitize) << "once is enough";
}

TEST(PatientReference, ShowsEverythingWhereThePatientIsNow) {
  Guided s;
  const ShownFrame at_rest = shown(s.pair());
  const Transform<World, World> moved{rotation_from_vector({0.0, 0.1, 0.0}), {0.01, 0.0, -0.02}};
  s.tracker().reference.world_from_anchored = moved;
  const ShownFrame after = shown(s.pair());
  ASSERT_EQ(after.holograms.size(), at_rest.holograms.size());
  std::size_t compared = 0;
  for (std::size_t h = 0; h < after.holograms.size(); ++h) {
    const auto& here = after.holograms[h].points_in_world;
    const auto& there = at_rest.holograms[h].points_in_world;
    ASSERT_EQ(here.size(), there.size());
    // The cross hangs beside the site as the head sees it, and the head did not move along.
    if (after.holograms[h].kind == HologramKind::kCross) {
      continue;
    }
    for (std::size_t p = 0; p < here.size(); ++p, ++compared) {
      constexpr double kFloat_m = 1e-6;
      EXPECT_LT((here[p] - moved * there[p]).norm(), kFloat_m);
    }
  }
  EXPECT_GT(compared, 5u);
}

TEST(PatientReference, TheSceneIsDrawnWhereThePatientIsNow) {
  Guided s;
  SceneBuilder builder;
  const auto entry_of = [&](const Guidance& guidance) {
    render::Scene scene;
    builder.update(guidance);
    builder.write_scene(guidance, scene);
    return scene.lines[0].points[0];
  };
  const render::Float3 before = entry_of(s.pair());
  s.tracker().reference.world_from_anchored = {Mat3::identity(), {0.0, 0.0, 0.05}};
  const render::Float3 after = entry_of(s.pair());
  constexpr float kFloat_m = 1e-5F;
  EXPECT_NEAR(after.z - before.z, 0.05F, kFloat_m);
}

}  // namespace
}  // namespace orthonav::engine::session_reference_test
