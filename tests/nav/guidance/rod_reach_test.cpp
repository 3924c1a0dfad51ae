#include <gtest/gtest.h>

#include <vector>

#include "nav/guidance/rod_bends.h"
#include "tests/nav/guidance/uneven_seats.h"

namespace orthonav::nav {
namespace {

// So far off the curve that one spine in ten has no rod under the strict rule.
constexpr double kSideways_m = 0.003;

/// The bends may reach into the tulips, and seats be missed by more, only where no other rod
/// exists.
TEST(RodInstructions, ReachIntoTulipsOnlyWhereNoOtherRodExists) {
  const RodBending bending;
  RodBending strict;
  strict.reach_m = 0.0;
  strict.last_tolerance_m = 0.0;
  int helped = 0;
  int refused = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const auto seats = uneven_seats(seed, 5 + static_cast<int>(seed % 2), kSideways_m);
    const auto told = rod_instructions(seats, bending);
    const auto strictly = rod_instructions(seats, strict);
    if (strictly) {
      ASSERT_TRUE(told.ok()) << told.error().message;
      EXPECT_EQ(told->reach_m, 0.0) << seed;
      EXPECT_EQ(told->fit.worst_off_m, strictly->fit.worst_off_m) << seed;
      continue;
    }
    ++refused;
    if (!told) {
      continue;
    }
    ++helped;
    EXPECT_GT(told->reach_m, 0.0) << seed;
    for (const RodInstruction& bend : told->bends) {
      // Off straight at the tulip's edge: half the square of the reach over the radius.
      const double off_m =
          0.5 * told->reach_m * told->reach_m * bend.arc.angle_rad / bending.bender.width_m;
      EXPECT_LT(off_m, 0.07e-3) << seed;
    }
  }
  EXPECT_GE(refused, 5) << "the strict rule refuses some of these spines";
  EXPECT_GE(2 * helped, refused) << "and at least half of them have a rod";
}

/// What was allowed once stays allowed: the bends still to come keep their places.
TEST(RodInstructions, KeepTheirReachAfterABend) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const auto told = rod_instructions(uneven_seats(seed, 6, kSideways_m), {});
    if (!told || told->reach_m == 0.0) {
      continue;
    }
    const std::vector<RodArc> made = {told->bends[0].arc};
    const auto after = rod_instructions_after(*told, made, {});
    ASSERT_TRUE(after.ok()) << after.error().message;
    EXPECT_EQ(after->reach_m, told->reach_m);
    EXPECT_NEAR(after->fit.worst_off_m, told->fit.worst_off_m, 0.05e-3);
    return;
  }
  FAIL() << "no spine needed bends that reach into tulips";
}

}  // namespace
}  // namespace orthonav::nav
