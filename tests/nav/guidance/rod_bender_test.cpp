#include "nav/guidance/rod_bender.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "base/angle.h"

namespace orthonav::nav::rod_bender_test {
namespace {

constexpr double kDiameter_m = 0.0055;
// Bisection is far more precise; a thousandth of a degree can't be read.
constexpr double kSameAngle_rad = 1e-3 * kRadiansPerDegree;

double rad(double degrees) { return degrees * kRadiansPerDegree; }

RodSpringBack titanium() { return RodSpringBack::of({}, {}, kDiameter_m).value(); }

std::string refusal_of(const RodBender& bender, const RodMaterial& material, double diameter_m) {
  const auto made = RodSpringBack::of(bender, material, diameter_m);
  return made.ok() ? "" : made.error().message;
}

/// Moment of the stress over the section, summed in thin strips.
double recovery_by_strips_rad(double set_rad) {
  const RodMaterial m;
  const RodBender b;
  const double radius = 0.5 * kDiameter_m;
  const double curvature = set_rad / b.width_m;
  constexpr int kStrips = 200000;
  double moment = 0.0;
  for (int i = 0; i < kStrips; ++i) {
    const double y = radius * (2.0 * (i + 0.5) / kStrips - 1.0);
    const double stress = std::min(std::abs(m.modulus_pa * curvature * y), m.yield_pa);
    moment +=
        stress * std::abs(y) * 2.0 * std::sqrt(radius * radius - y * y) * 2.0 * radius / kStrips;
  }
  const double inertia = std::numbers::pi / 4.0 * std::pow(radius, 4.0);
  return moment / (m.modulus_pa * inertia) * b.width_m;
}

TEST(RodSpringBack, RecoversTheMomentOfTheStressOverTheSection) {
  const RodSpringBack rod = titanium();
  for (const double set_deg : {1.0, 3.5, 8.0, 15.0, 30.0}) {
    const double set_rad = rad(set_deg);
    EXPECT_NEAR(set_rad - rod.kept_rad(set_rad), recovery_by_strips_rad(set_rad), kSameAngle_rad)
        << set_deg;
  }
}

TEST(RodSpringBack, TendsToThePublishedFormulaForWideAngles) {
  const double published_rad = 1.70 * 2.0 * 758e6 / (114e9 * kDiameter_m) * 0.020;
  EXPECT_NEAR(published_rad, rad(4.71), rad(0.01));
  const double wide_rad = rad(40.0) - titanium().kept_rad(rad(40.0));
  EXPECT_NEAR(wide_rad, published_rad, rad(0.1));
  // A small bend recovers less: the formula alone would take 20 % too much.
  const double small_rad = rad(5.0) - titanium().kept_rad(rad(5.0));
  EXPECT_LT(small_rad, 0.95 * published_rad);
}

TEST(RodSpringBack, ElasticBendsLeaveNothing) {
  EXPECT_NEAR(titanium().kept_rad(rad(2.0)), 0.0, kSameAngle_rad);
  EXPECT_GT(titanium().kept_rad(rad(4.0)), rad(0.1));
}

TEST(RodSpringBack, SetsWhatLeavesTheAngleWanted) {
  const RodSpringBack rod = titanium();
  for (const double kept_deg : {0.5, 5.0, 12.0, 30.0}) {
    const auto set_rad = rod.set_rad(rad(kept_deg));
    ASSERT_TRUE(set_rad.ok()) << set_rad.error().message;
    EXPECT_NEAR(rod.kept_rad(*set_rad), rad(kept_deg), kSameAngle_rad);
  }
}

TEST(RodSpringBack, RefusesRadiiBelowTheSmallest) {
  const RodSpringBack rod = titanium();
  // 10 % of strain in the outer fibre of 5.5 mm.
  EXPECT_DOUBLE_EQ(rod.smallest_radius_m(), 0.0275);
  EXPECT_TRUE(rod.set_rad(rod.most_kept_rad()).ok());
  const auto sharper = rod.set_rad(rod.most_kept_rad() + rad(0.2));
  ASSERT_FALSE(sharper.ok());
  EXPECT_EQ(sharper.error().message,
            "bend of 37.2° has a radius of 27.4 mm on the bender, limit 27.5 mm");
  RodBender wide;
  wide.die_radius_m = 0.050;
  EXPECT_DOUBLE_EQ(RodSpringBack::of(wide, {}, kDiameter_m)->smallest_radius_m(), 0.050);
}

TEST(RodSpringBack, FollowsItsTrials) {
  RodMaterial cobalt;
  cobalt.name = "CoCr";
  cobalt.trials = {{rad(6), rad(0)}, {rad(20), rad(13)}, {rad(40), rad(32)}};
  const auto rod = RodSpringBack::of({}, cobalt, kDiameter_m);
  ASSERT_TRUE(rod.ok()) << rod.error().message;
  EXPECT_NEAR(rod->kept_rad(rad(13)), rad(6.5), kSameAngle_rad);
  EXPECT_NEAR(rod->set_rad(rad(22.5)).value(), rad(30), kSameAngle_rad);
  EXPECT_EQ(rod->set_rad(rad(33)).error().message,
            "bend of 33.0° lies beyond the spring-back trials of CoCr, limit 32.0°");
}

TEST(RodSpringBack, RefusesTrialsThatAreNone) {
  const auto with = [](std::vector<SpringBackTrial> trials) {
    RodMaterial material;
    material.trials = std::move(trials);
    return refusal_of({}, material, kDiameter_m);
  };
  EXPECT_EQ(with({{rad(10), rad(11)}}),
            "spring-back trial 1 keeps 11.0°, limit 0-10.0°, what was set");
  EXPECT_EQ(with({{rad(10), rad(5)}, {rad(12), rad(5)}}),
            "spring-back trial 2 of 12.0° that keeps 5.0° does not rise from the one before");
  EXPECT_EQ(with({{rad(130), rad(90)}}), "spring-back trial 1 is set to 130.0°, limit 120°");
  EXPECT_EQ(with({{rad(4), 0.0}}), "spring-back trials keep no bend at all");
  EXPECT_EQ(with({{std::numeric_limits<double>::quiet_NaN(), 0.0}}),
            "spring-back trial 1 is not finite");
}

TEST(RodSpringBack, RefusesValuesThatNoBenderOrMetalHas) {
  EXPECT_EQ(refusal_of({0.0015, 0.02}, {}, kDiameter_m),
            "width of a bend is 1.5 mm, limit 2-100 mm");
  EXPECT_EQ(refusal_of({0.02, 0.6}, {}, kDiameter_m), "die radius is 600.0 mm, limit 1-500 mm");
  EXPECT_EQ(refusal_of({}, {}, 5.5), "rod diameter is 5500.0 mm, limit 1-15 mm");
  RodMaterial material;
  material.modulus_pa = std::numeric_limits<double>::infinity();
  EXPECT_EQ(refusal_of({}, material, kDiameter_m),
            "elastic modulus of the rod to bend is not finite");
  material = {};
  material.elongation = 0.0;
  EXPECT_EQ(refusal_of({}, material, kDiameter_m), "elongation is 0.0 %, limit 1-60 %");
}

TEST(RodSpringBack, RefusesNoAngle) {
  EXPECT_EQ(titanium().set_rad(-0.1).error().message, "bend of -5.7°, must be 0° or more");
  EXPECT_FALSE(titanium().set_rad(std::numeric_limits<double>::quiet_NaN()).ok());
}

}  // namespace
}  // namespace orthonav::nav::rod_bender_test
