#include "engine/session/guide_checks.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/session/placed_wire.h"

namespace orthonav::engine::axis_check_test {
namespace {

constexpr double kExact = 1e-12;
constexpr Direction<Marker> kDescribed{{0, 1, 0}};

nav::SpinCalibration measured(double off_rad, double sigma_rad) {
  nav::SpinCalibration spin;
  spin.axis_in_marker = {rotation_from_vector({off_rad, 0, 0}) * kDescribed.v};
  spin.axis_sigma_rad = sigma_rad;
  return spin;
}

TEST(AxisCheck, TakesTheMeanByWhatIsKnown) {
  AxisCheck check(PlacedWireRules{}.axis_sd_rad);
  EXPECT_FALSE(check.offers());
  // The SD about each direction equals that of the described axis, so half of the difference
  // counts.
  check.take(measured(0.012, 0.010 * std::sqrt(2.0)), kDescribed);
  ASSERT_TRUE(check.offers());
  EXPECT_NEAR(check.last()->off_rad, 0.012, kExact);
  EXPECT_NEAR(check.last()->by_rad, 0.006, kExact);
  const Direction<Marker> better = check.correct();
  EXPECT_NEAR(angle_between_rad(better.v, kDescribed.v), 0.006, kExact);
  EXPECT_NEAR(angle_between_rad(better.v, measured(0.012, 0.0).axis_in_marker.v), 0.006, kExact);
  EXPECT_FALSE(check.offers());
}

TEST(AxisCheck, WhatWasCorrectedIsKnownBetterFromThenOn) {
  AxisCheck check(PlacedWireRules{}.axis_sd_rad);
  check.take(measured(0.02, 0.002), kDescribed);
  const Direction<Marker> better = check.correct();
  // A poor measurement hardly changes it.
  check.take(measured(0.0, 0.02), better);
  EXPECT_LT(check.last()->by_rad, 0.001);
  EXPECT_FALSE(check.offers());
  AxisCheck fresh(PlacedWireRules{}.axis_sd_rad);
  fresh.take(measured(0.02, 0.02), kDescribed);
  EXPECT_GT(fresh.last()->by_rad, 0.005) << "the twin";
}

TEST(AxisCheck, IsNeverSurerThanTagsAndLensesAllow) {
  AxisCheck check(PlacedWireRules{}.axis_sd_rad);
  check.take(measured(0.01, 0.0), kDescribed);
  EXPECT_GE(check.last()->sd_rad, kLeastAxisSd_rad);
  EXPECT_LT(check.last()->by_rad, 0.01);
}

TEST(AxisCheck, HardlyOffIsNotWorthAWord) {
  AxisCheck check(PlacedWireRules{}.axis_sd_rad);
  check.take(measured(0.9 * kAxisWorth_rad, 0.001), kDescribed);
  EXPECT_FALSE(check.offers());
}

}  // namespace
}  // namespace orthonav::engine::axis_check_test
