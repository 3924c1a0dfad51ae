#include "nav/guidance/anatomical_deviation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace orthonav::nav::anatomical_deviation_test {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kRounding_m = 1e-15;
constexpr double kRounding_rad = 1e-14;

/// Converging to the midline by `medial_deg` and rising by `cranial_deg`, 40 mm long.
ScrewPlan plan_of(Side side, double medial_deg, double cranial_deg) {
  const double to_midline = side == Side::kLeft ? -1.0 : 1.0;
  const double level = std::cos(cranial_deg * kDegree);
  const Vec3 inward{to_midline * level * std::sin(medial_deg * kDegree),
                    -level * std::cos(medial_deg * kDegree), std::sin(cranial_deg * kDegree)};
  const Vec3 entry{-0.02 * to_midline, 0.03, 0.005};
  return {side, {entry}, {entry + 0.040 * inward}, 0.003};
}

Axis<Vertebra> on_plan(const ScrewPlan& plan) {
  return {plan.entry, (plan.target - plan.entry).normalized()};
}

/// SDs of the tool's pose relative to the bone, independent, about the origin.
PoseUncertainty uncertain(Vec3 translation_m, Vec3 rotation_rad) {
  std::array<double, 36> c{};
  for (int i = 0; i < 3; ++i) {
    c[static_cast<std::size_t>(7 * i)] = translation_m[i] * translation_m[i];
    c[static_cast<std::size_t>(7 * (i + 3))] = rotation_rad[i] * rotation_rad[i];
  }
  return {{0, 0, 0}, c};
}

TEST(ScrewDirections, PointToTheMidlineFromEitherSide) {
  // Straight in: LPS, +x is the patient's left, +z the head.
  const auto left = directions_of(plan_of(Side::kLeft, 0.0, 0.0));
  const auto right = directions_of(plan_of(Side::kRight, 0.0, 0.0));
  ASSERT_TRUE(left && right);
  EXPECT_EQ((left->medial - Vec3{-1, 0, 0}).norm(), 0.0);
  EXPECT_EQ((right->medial - Vec3{1, 0, 0}).norm(), 0.0);
  EXPECT_EQ((left->cranial - Vec3{0, 0, 1}).norm(), 0.0);
  EXPECT_EQ((right->cranial - Vec3{0, 0, 1}).norm(), 0.0);
}

TEST(ScrewDirections, StandSquareToAConvergentScrewAndMedialStaysAxial) {
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const auto d = directions_of(plan_of(side, 25.0, -12.0));
    ASSERT_TRUE(d);
    EXPECT_NEAR(d->inward.dot(d->cranial), 0.0, kRounding_m);
    EXPECT_NEAR(d->inward.dot(d->medial), 0.0, kRounding_m);
    EXPECT_NEAR(d->cranial.dot(d->medial), 0.0, kRounding_m);
    EXPECT_NEAR(d->medial.z, 0.0, kRounding_m);
    EXPECT_NEAR(d->cranial.z, std::cos(12.0 * kDegree), kRounding_m);
    EXPECT_NEAR(d->medial.x, (side == Side::kLeft ? -1 : 1) * std::cos(25.0 * kDegree),
                kRounding_m);
  }
}

TEST(ScrewDirections, AreNoneWhereTheWordsWouldMislead) {
  EXPECT_TRUE(directions_of(plan_of(Side::kLeft, 0.0, 59.0)));
  EXPECT_FALSE(directions_of(plan_of(Side::kLeft, 0.0, 61.0)));
  EXPECT_TRUE(directions_of(plan_of(Side::kLeft, 59.0, 0.0)));
  EXPECT_FALSE(directions_of(plan_of(Side::kLeft, 61.0, 0.0)));
}

TEST(AnatomicalDeviation, IsExactlyWhatTheToolIsOffOnEitherSide) {
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const ScrewPlan plan = plan_of(side, 20.0, 8.0);
    const auto d = directions_of(plan);
    Axis<Vertebra> tool = on_plan(plan);
    tool.point = tool.point + 0.0012 * d->cranial - 0.0008 * d->medial + 0.0100 * d->inward;
    const auto off = anatomical_deviation(plan, tool, nullptr);
    ASSERT_TRUE(off);
    EXPECT_NEAR(off->tip_cranial_m.value, 0.0012, kRounding_m);
    EXPECT_NEAR(off->tip_medial_m.value, -0.0008, kRounding_m);
    EXPECT_NEAR(off->depth_m.value, 0.0100, kRounding_m);
    EXPECT_NEAR(off->aim_cranial_rad.value, 0.0, kRounding_rad);
    EXPECT_NEAR(off->aim_medial_rad.value, 0.0, kRounding_rad);
  }
}

TEST(AnatomicalDeviation, SaysLateralWhereTheMirroredToolIsMedial) {
  // The same place in space, 1 mm towards the patient's right: medial of a left screw, lateral of a
  // right one. The wrong side of the plan would swap the words.
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const ScrewPlan plan = plan_of(side, 0.0, 0.0);
    Axis<Vertebra> tool = on_plan(plan);
    tool.point = tool.point + Vec3{-0.001, 0, 0};
    const auto off = anatomical_deviation(plan, tool, nullptr);
    EXPECT_NEAR(off->tip_medial_m.value, side == Side::kLeft ? 0.001 : -0.001, kRounding_m);
  }
}

TEST(AnatomicalDeviation, MeasuresEachAngleInItsOwnPlane) {
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const ScrewPlan plan = plan_of(side, 20.0, 8.0);
    const auto d = directions_of(plan);
    Axis<Vertebra> tool = on_plan(plan);
    const double angle_rad = 3.0 * kDegree;
    tool.direction = std::cos(angle_rad) * d->inward + std::sin(angle_rad) * d->medial;
    auto off = anatomical_deviation(plan, tool, nullptr);
    EXPECT_NEAR(off->aim_medial_rad.value, angle_rad, kRounding_rad);
    EXPECT_NEAR(off->aim_cranial_rad.value, 0.0, kRounding_rad);
    tool.direction = std::cos(angle_rad) * d->inward - std::sin(angle_rad) * d->cranial;
    off = anatomical_deviation(plan, tool, nullptr);
    EXPECT_NEAR(off->aim_cranial_rad.value, -angle_rad, kRounding_rad) << "aims caudal";
    EXPECT_NEAR(off->aim_medial_rad.value, 0.0, kRounding_rad);
  }
}

TEST(AnatomicalDeviation, DoesNotChangeWithThePatientsPose) {
  const ScrewPlan plan = plan_of(Side::kRight, 18.0, -5.0);
  const Transform<World, Vertebra> rotated{rotation_from_vector({0.7, -1.9, 0.4}),
                                           {1.0, -0.3, 2.0}};
  Axis<Vertebra> tool = on_plan(plan);
  tool.point = tool.point + Vec3{0.002, 0.001, -0.0015};
  tool.direction = (rotation_from_vector({0.03, 0.02, -0.05}) * tool.direction).normalized();
  const auto still = anatomical_deviation(plan, tool, nullptr);
  // Through World and back, like a tracked tool.
  const Point<World> tip = rotated * tool.point;
  const Vec3 direction = rotated.rotation() * tool.direction;
  const auto back = rotated.inverse();
  const auto moved = anatomical_deviation(plan, {back * tip, back.rotation() * direction}, nullptr);
  constexpr double kThereAndBack = 1e-15;
  EXPECT_NEAR(moved->tip_cranial_m.value, still->tip_cranial_m.value, kThereAndBack);
  EXPECT_NEAR(moved->tip_medial_m.value, still->tip_medial_m.value, kThereAndBack);
  EXPECT_NEAR(moved->aim_cranial_rad.value, still->aim_cranial_rad.value, kRounding_rad);
  EXPECT_NEAR(moved->aim_medial_rad.value, still->aim_medial_rad.value, kRounding_rad);
}

TEST(AnatomicalDeviation, CarriesThePosesUncertaintyIntoEachNumber) {
  const ScrewPlan plan = plan_of(Side::kLeft, 0.0, 0.0);  // medial -x, cranial +z, inward -y
  const auto without = anatomical_deviation(plan, on_plan(plan), nullptr);
  EXPECT_TRUE(std::isinf(without->tip_cranial_m.sd)) << "nobody knows it";
  EXPECT_TRUE(std::isinf(without->aim_medial_rad.sd));
  const PoseUncertainty translation = uncertain({0.0004, 0.0006, 0.0009}, {});
  const auto by_translation = anatomical_deviation(plan, on_plan(plan), &translation);
  EXPECT_NEAR(by_translation->tip_medial_m.sd, 0.0004, kRounding_m);
  EXPECT_NEAR(by_translation->depth_m.sd, 0.0006, kRounding_m);
  EXPECT_NEAR(by_translation->tip_cranial_m.sd, 0.0009, kRounding_m);
  EXPECT_EQ(by_translation->aim_medial_rad.sd, 0.0);
  // Turned about z by 0.01: the entry at (0.02, 0.03, 0.005) swings by 0.01 · (-0.03, 0.02, 0).
  const PoseUncertainty rotation = uncertain({}, {0, 0, 0.01});
  const auto by_rotation = anatomical_deviation(plan, on_plan(plan), &rotation);
  EXPECT_NEAR(by_rotation->tip_medial_m.sd, 0.0003, kRounding_m);
  EXPECT_NEAR(by_rotation->depth_m.sd, 0.0002, kRounding_m);
  EXPECT_NEAR(by_rotation->tip_cranial_m.sd, 0.0, kRounding_m);
  EXPECT_NEAR(by_rotation->aim_medial_rad.sd, 0.01, kRounding_rad);
  EXPECT_NEAR(by_rotation->aim_cranial_rad.sd, 0.0, kRounding_rad);
}

TEST(AnatomicalDeviation, IsNoneForAToolThatIsNotFinite) {
  const ScrewPlan plan = plan_of(Side::kLeft, 10.0, 0.0);
  Axis<Vertebra> tool = on_plan(plan);
  ASSERT_TRUE(anatomical_deviation(plan, tool, nullptr));
  tool.point.v.x = std::nan("");
  EXPECT_FALSE(anatomical_deviation(plan, tool, nullptr));
  EXPECT_FALSE(anatomical_deviation(plan_of(Side::kLeft, 80.0, 0.0),
                                    on_plan(plan_of(Side::kLeft, 80.0, 0.0)), nullptr));
}

}  // namespace
}  // namespace orthonav::nav::anatomical_deviation_test
