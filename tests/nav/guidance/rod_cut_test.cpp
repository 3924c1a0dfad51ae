#include "nav/guidance/rod_cut.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

namespace orthonav::nav {
namespace {

using ::testing::HasSubstr;

// Twice the spline's guaranteed tolerance, because two lengths are compared.
constexpr double kCutTolerance_m = 2e-6;
constexpr Vec3 kAnterior{0.0, -1.0, 0.0};

RodTemplate straight_rod() {
  const std::vector<Vec3> heads = {{0, 0, 0}, {0, 0, 0.03}, {0, 0, 0.07}, {0, 0, 0.11}};
  return rod_template(heads).value();
}

/// Heads every `step_rad` on a circle about the origin, and screws that point out of it.
struct Arc {
  RodTemplate rod;
  std::vector<Vec3> outwards;
};
Arc arc_of(double radius_m, double step_rad, int heads) {
  Arc arc;
  std::vector<Vec3> points;
  for (int i = 0; i < heads; ++i) {
    const double a = step_rad * i;
    arc.outwards.push_back({0.0, -std::cos(a), std::sin(a)});
    points.push_back(radius_m * arc.outwards.back());
  }
  arc.rod = rod_template(points).value();
  return arc;
}

std::string refusal(const RodTemplate& rod, std::span<const Vec3> to_bone,
                    const RodSeating& seating) {
  const auto cut = rod_cut(rod, to_bone, seating);
  return cut.ok() ? "" : cut.error().message;
}

/// The direction is off the screws' mean by 25° along the rod and 20° to the side, as a pointer is
/// held.
TEST(ToBoneAcross, FindsTheSeatsOfALordosisByOneDirectionForAllHeads) {
  const Arc arc = arc_of(0.15, 0.2, 5);
  const Vec3 mean = arc.outwards[2];
  const Vec3 along = Vec3{1, 0, 0}.cross(mean);
  const Vec3 pointed = mean + std::tan(0.436) * along + std::tan(0.349) * Vec3{1, 0, 0};
  const auto across = to_bone_across(arc.rod, pointed);
  ASSERT_TRUE(across.ok()) << across.error().message;
  ASSERT_EQ(across->size(), 5U);
  const double best_m = rod_cut(arc.rod, arc.outwards, {0.006, 0.0})->seated_length_m;
  const double found_m = rod_cut(arc.rod, *across, {0.006, 0.0})->seated_length_m;
  EXPECT_NEAR(found_m, best_m, 0.0005) << "of 4.8 mm that the depth adds";
  const std::vector<Vec3> alike(5, pointed);
  EXPECT_LT(rod_cut(arc.rod, alike, {0.006, 0.0})->seated_length_m, best_m - 0.004)
      << "control: not square to the rod";
}

TEST(ToBoneAcross, RefusesADirectionAlongTheRod) {
  const auto tilted = [](double off_deg) {
    const double off_rad = off_deg * 3.14159265358979 / 180.0;
    return to_bone_across(straight_rod(), {0.0, -std::sin(off_rad), std::cos(off_rad)});
  };
  EXPECT_TRUE(tilted(30.1).ok());
  ASSERT_FALSE(tilted(29.9).ok());
  EXPECT_EQ(tilted(29.9).error().message,
            "direction to the bone is 29.9° off the rod, at least 30° needed");
  ASSERT_FALSE(to_bone_across(straight_rod(), {}).ok());
  EXPECT_THAT(to_bone_across(straight_rod(), {}).error().message, HasSubstr("zero or not finite"));
}

TEST(RodCut, AddsTheOverhangAtBothEndsOfAStraightRod) {
  const std::vector<Vec3> to_bone(4, 3.0 * kAnterior);  // of any length
  const auto cut = rod_cut(straight_rod(), to_bone, {0.006, 0.005});
  ASSERT_TRUE(cut.ok()) << cut.error().message;
  EXPECT_NEAR(cut->seated_length_m, 0.110, kCutTolerance_m);
  EXPECT_DOUBLE_EQ(cut->cut_length_m, cut->seated_length_m + 0.010);
  ASSERT_EQ(cut->seats_m.size(), 4U);
  EXPECT_LT((cut->seats_m[2] - Vec3{0, -0.006, 0.07}).norm(), 1e-15);
}

TEST(RodCut, TakesTheSeatOfEachHeadWhereTheyDiffer) {
  const std::vector<Vec3> to_bone(4, kAnterior);
  RodSeating seating{0.006, 0.005, {0.006, 0.008, 0.006, 0.0}};
  const auto cut = rod_cut(straight_rod(), to_bone, seating);
  ASSERT_TRUE(cut.ok()) << cut.error().message;
  EXPECT_NEAR(cut->seats_m[1].y, -0.008, 1e-12);
  EXPECT_NEAR(cut->seats_m[3].y, 0.0, 1e-12);
  seating.each_head_to_seat_m = {0.006};
  EXPECT_THAT(refusal(straight_rod(), to_bone, seating), HasSubstr("1 distances to a seat"));
  // Touched in the drive socket: the rod lies above it, away from the bone.
  seating.each_head_to_seat_m = {0.006, 0.006, -0.004, 0.006};
  const auto above = rod_cut(straight_rod(), to_bone, seating);
  ASSERT_TRUE(above.ok()) << above.error().message;
  EXPECT_NEAR(above->seats_m[2].y, 0.004, 1e-12);
  seating.each_head_to_seat_m = {0.006, 0.006, -0.0151, 0.006};
  EXPECT_THAT(refusal(straight_rod(), to_bone, seating), HasSubstr("distance from head to seat"));
}

TEST(RodCut, WithoutDepthAndOverhangIsTheTemplatesLength) {
  const Arc arc = arc_of(0.2, 0.17, 5);
  const auto cut = rod_cut(arc.rod, arc.outwards, {0.0, 0.0});
  ASSERT_TRUE(cut.ok()) << cut.error().message;
  EXPECT_NEAR(cut->cut_length_m, arc.rod.length_m, kCutTolerance_m);
}

TEST(RodCut, IsLongerOnTheOutsideOfACircleByDepthTimesAngle) {
  const Arc arc = arc_of(0.2, 0.1, 7);
  const auto cut = rod_cut(arc.rod, arc.outwards, {0.006, 0.0});
  ASSERT_TRUE(cut.ok()) << cut.error().message;
  // Seats on a circle of 206 mm: the same spline, larger by 206 / 200.
  EXPECT_NEAR(cut->seated_length_m, arc.rod.length_m * 0.206 / 0.2, kCutTolerance_m);
  // The true arc: the spline cuts the corners of its two end segments by less than 0.1 mm.
  EXPECT_NEAR(cut->seated_length_m, 0.206 * 0.6, 1e-4);
  // The heads' length would be short by 3.6 mm, far beyond that tolerance.
  EXPECT_GT(std::abs(arc.rod.length_m - 0.206 * 0.6), 3e-3);
}

TEST(RodCut, KeepsItsLengthWhenEverythingIsTurnedAndMoved) {
  const Arc arc = arc_of(0.2, 0.15, 4);
  const Mat3 rotation = rotation_from_vector({0.3, -1.1, 0.7});
  RodTemplate moved = arc.rod;
  std::vector<Vec3> outwards;
  for (std::size_t i = 0; i < moved.heads_m.size(); ++i) {
    moved.heads_m[i] = rotation * moved.heads_m[i] + Vec3{1.0, -2.0, 0.5};
    outwards.push_back(rotation * arc.outwards[i]);
  }
  const auto cut = rod_cut(arc.rod, arc.outwards);
  const auto rotated = rod_cut(moved, outwards);
  ASSERT_TRUE(cut.ok() && rotated.ok());
  EXPECT_NEAR(rotated->cut_length_m, cut->cut_length_m, kCutTolerance_m);
}

TEST(RodCut, TakesItsLimitsAndRefusesWhatIsJustBeyond) {
  const RodTemplate rod = straight_rod();
  const std::vector<Vec3> to_bone(4, kAnterior);
  EXPECT_TRUE(rod_cut(rod, to_bone, {-0.015, 0.0}).ok());
  EXPECT_TRUE(rod_cut(rod, to_bone, {0.03, 0.05}).ok());
  EXPECT_EQ(refusal(rod, to_bone, {0.006, 0.0501}),
            "overhang of the rod is 50.1 mm, limit 0-50 mm");
  EXPECT_EQ(refusal(rod, to_bone, {0.006, -0.001}),
            "overhang of the rod is -1.0 mm, limit 0-50 mm");
  EXPECT_EQ(refusal(rod, to_bone, {0.0302, 0.0}),
            "distance from head to seat is 30.2 mm, limit -15 to 30 mm");
  EXPECT_EQ(refusal(rod, to_bone, {-0.0152, 0.0}),
            "distance from head to seat is -15.2 mm, limit -15 to 30 mm");
}

TEST(RodCut, RefusesWhatIsNotFinite) {
  constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();
  constexpr double kEndless = std::numeric_limits<double>::infinity();
  RodTemplate rod = straight_rod();
  std::vector<Vec3> to_bone(4, kAnterior);
  EXPECT_EQ(refusal(rod, to_bone, {kNotANumber, 0.0}), "distance from head to seat is not finite");
  EXPECT_EQ(refusal(rod, to_bone, {0.006, kEndless}), "overhang of the rod is not finite");
  to_bone[1] = {};
  EXPECT_THAT(refusal(rod, to_bone, {}), HasSubstr("direction of screw 2 is zero"));
  to_bone[1] = {kNotANumber, 0.0, 0.0};
  EXPECT_THAT(refusal(rod, to_bone, {}), HasSubstr("direction of screw 2 is zero or not finite"));
  to_bone[1] = kAnterior;
  rod.heads_m[2].y = kNotANumber;
  EXPECT_EQ(refusal(rod, to_bone, {}), "screw head 3 is not finite");
}

TEST(RodCut, RefusesTooFewHeadsAndOtherCounts) {
  RodTemplate rod = straight_rod();
  EXPECT_EQ(refusal(rod, std::vector<Vec3>(3, kAnterior), {}),
            "rod to cut has 4 screw heads, but 3 directions of screws");
  rod.heads_m.resize(1);
  EXPECT_EQ(refusal(rod, std::vector<Vec3>(1, kAnterior), {}),
            "rod to cut needs at least 2 screw heads, got 1");
  rod.heads_m = {{0, 0, 0}, {0, 0, 0.01}};
  const std::vector<Vec3> crossing = {{0, 0, 1}, {0, 0, -1}};
  EXPECT_THAT(refusal(rod, crossing, {0.005, 0.0}), HasSubstr("seats of the rod: "));
}

}  // namespace
}  // namespace orthonav::nav
