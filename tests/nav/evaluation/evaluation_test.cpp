#include "nav/evaluation/errors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "tests/support/mesh_builder.h"

namespace orthonav::nav {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// A slab whose back (+y) is the plane y = 20 mm.
const SurfaceIndex& slab() {
  static const SurfaceIndex index(test::box({-0.05, -0.02, -0.05}, {0.05, 0.02, 0.05}));
  return index;
}
const ScrewPlan kPlan{Side::kRight, {{0.01, 0.02, 0.0}}, {{0.01, -0.015, 0.0}}, 0.003};

TEST(ScrewError, IsZeroForThePlanItself) {
  const ScrewError e = screw_error(kPlan, {kPlan.target, {0, -1, 0}}, slab());
  EXPECT_NEAR(e.angle_rad, 0.0, 1e-15);
  ASSERT_TRUE(e.entry_m);
  EXPECT_NEAR(*e.entry_m, 0.0, 1e-15);
}

TEST(ScrewError, TakesTheEntryWhereTheTrajectoryComesIn) {
  // Tilted by 10 degrees about the target: the entry moves by 35 mm · tan 10°.
  const double a = 10.0 * kDegree;
  const Vec3 direction = 5.0 * Vec3{std::sin(a), -std::cos(a), 0};
  const ScrewError e = screw_error(kPlan, {kPlan.target, direction}, slab());
  EXPECT_NEAR(e.angle_rad, a, 1e-14);
  ASSERT_TRUE(e.entry_m);
  EXPECT_NEAR(*e.entry_m, 0.035 * std::tan(a), 1e-14);
}

TEST(ScrewError, DoesNotDependOnWhichPointOfTheAxisIsGiven) {
  const Vec3 direction = Vec3{0.1, -1, 0.05}.normalized();
  const Point<Vertebra> on_axis{{0.012, 0.0, 0.003}};
  const ScrewError inside = screw_error(kPlan, {on_axis, direction}, slab());
  ASSERT_TRUE(inside.entry_m);
  for (const double along_m : {-3.0, -0.2, 0.01, 0.04, 0.3, 2.0}) {
    const ScrewError e = screw_error(kPlan, {on_axis + along_m * direction, direction}, slab());
    ASSERT_TRUE(e.entry_m) << along_m;
    EXPECT_NEAR(*e.entry_m, *inside.entry_m, 1e-12) << along_m;
  }
}

TEST(ScrewError, HasNoEntryWhenTheTrajectoryMissesTheBone) {
  const ScrewError e = screw_error(kPlan, {{{0.0501, 0, 0}}, {0, -1, 0}}, slab());
  EXPECT_FALSE(e.entry_m);
  EXPECT_NEAR(e.angle_rad, 0.0, 1e-15);
  EXPECT_TRUE(screw_error(kPlan, {{{0.0499, 0, 0}}, {0, -1, 0}}, slab()).entry_m);
}

TEST(ScrewError, CountsATrajectoryDrivenBackwards) {
  EXPECT_NEAR(screw_error(kPlan, {kPlan.target, {0, 1, 0}}, slab()).angle_rad, std::numbers::pi,
              1e-15);
}

TEST(Summary, IsThatOfThePapersTable) {
  const std::vector<double> values = {2.0, 4.0, 4.0, 4.0, 5.0, 5.0, 7.0, 9.0};
  const Summary s = summarize(values);
  EXPECT_EQ(s.count, 8U);
  EXPECT_DOUBLE_EQ(s.mean, 5.0);
  EXPECT_NEAR(s.sd, std::sqrt(32.0 / 7.0), 1e-15);
  EXPECT_EQ(s.min, 2.0);
  EXPECT_EQ(s.max, 9.0);
}

TEST(Summary, OfOneValueHasNoSpreadAndOfNoneIsZero) {
  const std::vector<double> one = {-3.5};
  EXPECT_EQ(summarize(one).mean, -3.5);
  EXPECT_EQ(summarize(one).sd, 0.0);
  EXPECT_EQ(summarize({}).count, 0U);
  EXPECT_EQ(summarize({}).max, 0.0);
}

}  // namespace
}  // namespace orthonav::nav
