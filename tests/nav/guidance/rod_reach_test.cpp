#include <gtest/gtest.h>

#include <vector>

#include "nav/guidance/rod_bends.h"
#include "tests/nav/guidance/uneven_seats.h"

namespace orthonav::nav {
namespace {

// So far off the curve that one spine in ten has no rod under the strict rule.
constexpr double kSideways_m = 0.003;

/// Bends may reach a little into the tulips, which saves some of the spines.
TEST(RodInstructions, ReachIntoTulipsByLittleAndBendMoreSpinesSo) {
  const RodBending bending;
  RodBending strict;
  strict.reach_m = 0.0;
  int helped = 0;
  int refused = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const auto seats = uneven_seats(seed, 5 + static_cast<int>(seed % 2), kSideways_m);
    const auto told = rod_instructions(seats, bending);
    const auto strictly = rod_instructions(seats, strict);
    refused += strictly ? 0 : 1;
    helped += told && !strictly ? 1 : 0;
    EXPECT_FALSE(strictly && !told) << seed;
    if (!told) {
      continue;
    }
    EXPECT_LE(told->reach_m, bending.reach_m + 1e-6) << seed;
    for (const RodInstruction& bend : told->bends) {
      // Off straight at the tulip's edge: half the square of the reach over the radius.
      const double off_m =
          0.5 * told->reach_m * told->reach_m * bend.arc.angle_rad / bending.bender.width_m;
      EXPECT_LT(off_m, 0.07e-3) << seed;
    }
  }
  EXPECT_GE(refused, 5) << "the strict rule refuses some of these spines";
  EXPECT_GT(helped, 0) << "and some of them have a rod";
}

}  // namespace
}  // namespace orthonav::nav
