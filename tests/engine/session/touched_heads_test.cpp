#include "engine/session/touched_heads.h"

#include <gmock/gmock.h>

#include <cmath>

namespace orthonav::engine {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

// Arithmetic on values of the order of 1: far below what any device resolves.
constexpr double kExact = 1e-12;
constexpr double kTipSd_m = 0.0001;

nav::PressedPlace at(double x_m, double z_m = 0.0) { return {{{x_m, 0.0, z_m}}, kTipSd_m}; }

class Heads : public ::testing::Test {
 protected:
  HeadTouch touch(double x_m, double z_m = 0.0) {
    const auto added = heads.add(at(x_m, z_m));
    EXPECT_TRUE(std::holds_alternative<HeadTouch>(added));
    return std::holds_alternative<HeadTouch>(added) ? std::get<HeadTouch>(added) : HeadTouch{};
  }
  TouchedHeads heads{true};
};

TEST_F(Heads, TouchedAgainAreTheMeanOfTheirTouches) {
  touch(0.0);
  touch(0.0, 0.035);
  const HeadTouch again = touch(0.0006);
  EXPECT_EQ(again.head, 0U);
  EXPECT_EQ(again.touches, 2U);
  ASSERT_EQ(heads.heads(), 2U);
  EXPECT_NEAR(heads.places()[0].v.x, 0.0003, kExact);
  EXPECT_NEAR(heads.places()[1].v.z, 0.035, kExact);
}

TEST_F(Heads, AreOtherOnesFromTheStatedDistanceOn) {
  touch(0.0);
  EXPECT_EQ(touch(kSameHead_m + 1e-6).head, 1U);
  EXPECT_TRUE(std::holds_alternative<TouchRefusal>(heads.add(at(-kSameHead_m + 1e-6))))
      << "so near it belongs to the head, but not that far off";
}

TEST_F(Heads, BecomeSurerWithEachTouch) {
  const double once_m = touch(0.0).head_sd_m;
  EXPECT_NEAR(
      once_m,
      std::hypot(std::sqrt(0.75) * std::hypot(kSeatingSd_m, kTipSd_m), kHeadTrackingSdAnchored_m),
      1e-6);
  const double twice_m = touch(0.0).head_sd_m;
  EXPECT_LT(twice_m, once_m);
  EXPECT_LT(touch(0.0).head_sd_m, twice_m);
  for (int i = 0; i < 100; ++i) {
    touch(0.0);
  }
  EXPECT_GT(heads.sd_m(0), kHeadTrackingSdAnchored_m) << "tracking is not averaged away";
}

TEST_F(Heads, AreLessSureWhereTouchesScatterAndOnTheMap) {
  touch(0.0);
  TouchedHeads scattered = heads;
  const double alike_m = touch(0.0).head_sd_m;
  EXPECT_GT(std::get<HeadTouch>(scattered.add(at(0.001))).head_sd_m, alike_m);
  TouchedHeads on_map{false};
  EXPECT_GT(std::get<HeadTouch>(on_map.add(at(0.0))).head_sd_m, 0.00037);
}

TEST_F(Heads, RefuseATouchThatDisagrees) {
  touch(0.0);
  const double limit_m = kHeadSds * std::sqrt(2.0) *
                         std::hypot(std::hypot(kSeatingSd_m, kTipSd_m), kHeadTrackingSdAnchored_m);
  const auto refused = heads.add(at(limit_m + 1e-6));
  ASSERT_TRUE(std::holds_alternative<TouchRefusal>(refused));
  const auto& why = std::get<TouchRefusal>(refused);
  EXPECT_EQ(why.kind, TouchRefusal::Kind::kTouchesApart);
  EXPECT_NEAR(why.limit_m, limit_m, kExact);
  EXPECT_NEAR(why.value_m, limit_m + 1e-6, kExact);
  EXPECT_EQ(heads.touches_of(0), 1U) << "and it does not count";
  EXPECT_EQ(touch(limit_m - 1e-6).touches, 2U);
}

TEST_F(Heads, GiveTheirTouchesBackOneByOne) {
  EXPECT_FALSE(heads.drop_last());
  touch(0.0);
  touch(0.0, 0.035);
  touch(0.0008);
  EXPECT_EQ(heads.drop_last()->touches, 2U);
  ASSERT_EQ(heads.heads(), 2U);
  EXPECT_EQ(heads.places()[0].v.x, 0.0);
  EXPECT_EQ(heads.drop_last()->head, 1U);
  EXPECT_EQ(heads.heads(), 1U);
  EXPECT_EQ(touch(0.0, 0.070).head, 1U) << "the number is free again";
}

}  // namespace
}  // namespace orthonav::engine
