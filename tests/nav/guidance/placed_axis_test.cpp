#include "nav/guidance/placed_axis.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"

namespace orthonav::nav::placed_axis_test {
namespace {

constexpr double kRounding = 1e-12;
const ScrewPlan kPlan{Side::kLeft, {{0.015, 0.020, 0.0}}, {{0.015, -0.020, 0.0}}, 0.003};

/// A sleeve `out_m` out of the bone on a line that passes the entry `beside_m` towards +x and is
/// tilted by `lean_rad` about z.
Axis<Vertebra> sleeve(double out_m, double beside_m, double lean_rad) {
  const Vec3 direction{std::sin(lean_rad), -std::cos(lean_rad), 0.0};
  const Vec3 nearest = kPlan.entry.v + beside_m * Vec3{std::cos(lean_rad), std::sin(lean_rad), 0.0};
  return {{nearest - out_m * direction}, direction};
}

PoseUncertainty uncertain(double translation_m, double rotation_rad) {
  std::array<double, 36> c{};
  for (std::size_t i = 0; i < 3; ++i) {
    c[7 * i] = translation_m * translation_m;
    c[7 * (i + 3)] = rotation_rad * rotation_rad;
  }
  return {kPlan.entry.v, c};
}

TEST(PlacedAxis, IsALineWhereverTheSleeveStandsOnIt) {
  for (const double out_m : {-0.010, 0.0, 0.030, 0.060}) {
    const PlacedAxis found = placed_axis(kPlan, sleeve(out_m, 0.0013, 0.03), uncertain(0, 0), {});
    EXPECT_NEAR(found.angle_rad.value, 0.03, kRounding) << out_m;
    EXPECT_NEAR(found.entry_m.value, 0.0013, kRounding) << out_m;
    EXPECT_NEAR(found.line.direction.dot(found.line.point - kPlan.entry), 0.0, kRounding);
  }
}

TEST(PlacedAxis, OnThePlanIsZeroAndHasSds) {
  const PlacedAxis found = placed_axis(kPlan, sleeve(0.01, 0.0, 0.0), uncertain(0.0004, 0.003), {});
  EXPECT_NEAR(found.angle_rad.value, 0.0, kRounding);
  EXPECT_NEAR(found.entry_m.value, 0.0, kRounding);
  EXPECT_NEAR(found.angle_rad.sd, 0.003, kRounding);
  EXPECT_NEAR(found.entry_m.sd, 0.0004, kRounding);
}

TEST(PlacedAxis, AnErrorOfTheAxisCountsAtTheEntryByTheWayToIt) {
  const SleeveErrors errors{0.010, 0.0005};
  const PlacedAxis near = placed_axis(kPlan, sleeve(0.0, 0.001, 0.01), uncertain(0, 0), errors);
  const PlacedAxis far = placed_axis(kPlan, sleeve(0.05, 0.001, 0.01), uncertain(0, 0), errors);
  EXPECT_NEAR(near.entry_m.sd, 0.0005, kRounding);
  EXPECT_NEAR(far.entry_m.sd, std::hypot(0.0005, 0.05 * 0.010), kRounding);
  EXPECT_NEAR(near.angle_rad.sd, 0.010, kRounding);
  EXPECT_NEAR(far.angle_rad.sd, 0.010, kRounding);
}

/// Uses a wire well off the plan, so that its distance is nearly linear in the errors.
TEST(PlacedAxis, TheSdsAreThoseOfDraws) {
  constexpr int kDraws = 4000;
  constexpr double kSampling =
      0.05;  // relative error of an SD from these draws, more than four SDs of it
  constexpr double kTranslation_m = 0.0004;
  constexpr double kRotation_rad = 0.004;
  const SleeveErrors errors{0.006, 0.0003};
  const Axis<Vertebra> actual = sleeve(0.02, 0.006, 0.08);
  const PlacedAxis told =
      placed_axis(kPlan, actual, uncertain(kTranslation_m, kRotation_rad), errors);
  Random random(3);
  const auto draw = [&random](double sd) {
    return Vec3{random.normal(0, sd), random.normal(0, sd), random.normal(0, sd)};
  };
  double angle_squares = 0.0;
  double entry_squares = 0.0;
  for (int i = 0; i < kDraws; ++i) {
    const Vec3 translation = draw(kTranslation_m) + draw(errors.tip_m);
    const Mat3 pose = rotation_from_vector(draw(kRotation_rad));
    const Vec3 tip = kPlan.entry.v + pose * (actual.point - kPlan.entry) + translation;
    const Vec3 direction = pose * (rotation_from_vector(draw(errors.axis_rad)) * actual.direction);
    const PlacedAxis seen = placed_axis(kPlan, {{tip}, direction}, uncertain(0, 0), {});
    angle_squares += std::pow(seen.angle_rad.value - told.angle_rad.value, 2);
    entry_squares += std::pow(seen.entry_m.value - told.entry_m.value, 2);
  }
  EXPECT_NEAR(std::sqrt(angle_squares / kDraws) / told.angle_rad.sd, 1.0, kSampling);
  EXPECT_NEAR(std::sqrt(entry_squares / kDraws) / told.entry_m.sd, 1.0, kSampling);
}

}  // namespace
}  // namespace orthonav::nav::placed_axis_test
