#include <gmock/gmock.h>

#include "engine/holograms/shapes/hologram_shapes.h"
#include "tests/engine/holograms/shown_holograms.h"
#include "tests/support/scripted_operation.h"

namespace orthonav::engine::scene_builder_test {
namespace {

using test::guide_at;
using test::ScriptedOperation;
using enum ClickerAction;
using ::testing::StartsWith;
using enum HologramKind;

/// The first screw's wire stands; World is Vertebra.
class PlacedWireShown : public ::testing::Test {
 protected:
  PlacedWireShown() : s({"L4"}, test::three_places(), Verification::kByTouch, false, true) {
    s.registers_within(0.0003);
    s.accepts_first_by_touch();
    s.touches_landmark();
    s.says("next");
    s.tracker().guide = guide_at(kLeftEntry, 0.0);
    s.pairs(3);
    s.says("next");
  }
  const Guidance& measures(double beside_m) {
    s.tracker().guide = guide_at(kLeftEntry + Vec3{beside_m, 0.004, 0}, 0.0);
    s.does({kPress});
    s.pair();
    s.does({kRelease, kClick});
    return s.pair();
  }
  ScriptedOperation s;
};

/// Each part of H4 that a frame tells of: the plan, then the wire.
std::vector<ShownHologram> trajectories(const ShownFrame& frame) {
  std::vector<ShownHologram> found;
  for (const ShownHologram& hologram : frame.holograms) {
    if (hologram.kind == kTrajectory) {
      found.push_back(hologram);
    }
  }
  return found;
}

TEST_F(PlacedWireShown, IsALineBesideThePlanWithItsNumbers) {
  EXPECT_THAT(drawn(s.pair()), ::testing::ElementsAre(kEntry, kTrajectory, kStatus))
      << "no triangle and no number of the tool, which stands beside";
  EXPECT_EQ(trajectories(shown(s.pair())).size(), 1u) << "the plan alone";
  const Guidance& g = measures(0.0012);
  EXPECT_THAT(drawn(g), ::testing::ElementsAre(kEntry, kTrajectory, kStatus));
  EXPECT_EQ(drawn(g), told(g));
  const auto both = trajectories(shown(g));
  ASSERT_EQ(both.size(), 2u);
  EXPECT_THAT(both[1].text, StartsWith("0.0°, 1.2 mm"));
  ASSERT_EQ(both[1].points_in_world.size(), 3u);
  constexpr double kJoined = 1e-5;  // the touched check points move the registration by micrometres
  EXPECT_NEAR((both[1].points_in_world[1] - both[0].points_in_world[1]).norm(), 0.0012, kJoined);
}

TEST_F(PlacedWireShown, BeyondALimitIsRed) {
  const auto colour = [](const Guidance& g) {
    const render::Scene scene = scene_of(g);
    for (const auto& line : scene.lines) {
      if (line.label == 402) {
        return line.colour;
      }
    }
    return render::Colour{};
  };
  EXPECT_EQ(colour(measures(0.0012)), look::colours().placed);
  EXPECT_EQ(colour(measures(0.0032)), look::colours().poor);
}

TEST_F(PlacedWireShown, IsHiddenWithTheReferenceAndGoneWithItsRegistration) {
  measures(0.0012);
  s.tracker().reference_seen = false;
  EXPECT_THAT(drawn(s.pairs(5)), ::testing::ElementsAre(kStatus));
  s.tracker().reference_seen = true;
  EXPECT_EQ(trajectories(shown(s.pair())).size(), 2u) << "seen again";
  EXPECT_TRUE(trajectories(shown(s.says("reject"))).empty());
}

}  // namespace
}  // namespace orthonav::engine::scene_builder_test
