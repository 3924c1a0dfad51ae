#include "nav/guidance/other_entry.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/mesh_builder.h"

namespace orthonav::nav::other_entry_test {
namespace {

constexpr double kRounding = 1e-9;
/// The finer of the two grids, and what `least_clearance` promises.
constexpr double kGrid_m = 0.0002;
constexpr double kTolerance_m = 0.00005;

/// A box of these widths on either side of the plan (x), 60 mm deep and 60 mm high; +y is behind.
SurfaceIndex box(double left_m, double right_m) {
  return SurfaceIndex(test::box({-left_m, -0.040, -0.030}, {right_m, 0.020, 0.030}));
}
const ScrewPlan kPlan{Side::kLeft, {{0.0, 0.020, 0.0}}, {{0.0, -0.015, 0.0}}, 0.003};

TEST(OtherEntry, IsAsFarFromTheHoleAsAskedAndLeavesTheTarget) {
  const SurfaceIndex bone = box(0.020, 0.020);
  OtherEntryRules rules;
  rules.from_hole_m = 0.004;
  const auto found = other_entry(kPlan, kPlan.entry, bone, rules);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->entry.v.y, 0.020, kRounding) << "on the surface";
  EXPECT_GE((found->entry - kPlan.entry).norm(), 0.004);
  EXPECT_NEAR(found->from_hole_m, (found->entry - kPlan.entry).norm(), kRounding);
  const ScrewPlan redone{Side::kLeft, found->entry, kPlan.target, kPlan.radius_m};
  const auto clearance = least_clearance(bone, *cylinder_of(redone));
  ASSERT_TRUE(clearance);
  EXPECT_NEAR(found->clearance.clearance_m, clearance->clearance_m, kRounding);
}

TEST(OtherEntry, KeepsTheLargestClearanceOfAllPlacesThatAreFarEnough) {
  // The nearer wall is on the right, so the best entry is on the left of the hole. The nearest
  // allowed one is not the best: farther left is farther from the wall.
  const SurfaceIndex bone = box(0.030, 0.0045);
  const Point<Vertebra> hole{{0.001, 0.020, 0.0}};
  const auto found = other_entry(kPlan, hole, bone);
  ASSERT_TRUE(found);
  double best_m = 0.0;
  for (double x = -0.008; x <= 0.008; x += kGrid_m) {
    const ScrewPlan there{Side::kLeft, {{x, 0.020, 0.0}}, kPlan.target, kPlan.radius_m};
    if (std::abs(x - hole.v.x) >= OtherEntryRules{}.from_hole_m) {
      best_m = std::max(best_m, least_clearance(bone, *cylinder_of(there))->clearance_m);
    }
  }
  EXPECT_LT(found->entry.v.x, hole.v.x - OtherEntryRules{}.from_hole_m + kRounding);
  EXPECT_GE(found->clearance.clearance_m, best_m - kTolerance_m);
}

TEST(OtherEntry, IsNoneWhereNoScrewStaysInside) {
  // 2 x 4.2 mm wide and as high: the screw fits 1 mm beside the plan, and nowhere 3.2 mm beside.
  const SurfaceIndex narrow(test::box({-0.0042, -0.040, -0.0042}, {0.0042, 0.020, 0.0042}));
  EXPECT_FALSE(other_entry(kPlan, kPlan.entry, narrow));
  OtherEntryRules nearer;
  nearer.from_hole_m = 0.0009;
  EXPECT_TRUE(other_entry(kPlan, kPlan.entry, narrow, nearer)) << "the twin";
}

TEST(OtherEntry, IsNoneOfAPlanWithoutARadius) {
  ScrewPlan plan = kPlan;
  plan.radius_m = 0.0;
  EXPECT_FALSE(other_entry(plan, plan.entry, box(0.020, 0.020)));
}

TEST(OtherEntry, IsNotOnASlopeOnWhichADrillSlips) {
  const SurfaceIndex bone = box(0.020, 0.020);
  OtherEntryRules rules;
  // Every axis to the target is tilted by more than this against the flat back.
  rules.steepest_rad = std::atan2(rules.from_hole_m - 0.0001, 0.035);
  EXPECT_FALSE(other_entry(kPlan, kPlan.entry, bone, rules));
  rules.steepest_rad = std::atan2(rules.from_hole_m + 0.0005, 0.035);
  EXPECT_TRUE(other_entry(kPlan, kPlan.entry, bone, rules)) << "the twin, on the coarse grid";
}

}  // namespace
}  // namespace orthonav::nav::other_entry_test
