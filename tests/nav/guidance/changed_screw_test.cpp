#include "nav/guidance/changed_screw.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/angle.h"

namespace orthonav::nav::changed_screw_test {
namespace {

constexpr double kExact = 1e-12;
constexpr double kMm = 1e-3;

/// A roof that falls by 1 mm per mm left of x = 0 and is flat at y = 0 right of it: two faces, seen
/// from behind (+y).
SurfaceIndex roof() {
  TriangleMesh mesh;
  mesh.vertices_m = {{0, 0, -0.1},      {0, 0, 0.1},    {0.1, -0.1, 0.1},
                     {0.1, -0.1, -0.1}, {-0.1, 0, 0.1}, {-0.1, 0, -0.1}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 5, 4}, {0, 4, 1}};
  return SurfaceIndex(mesh);
}

/// 40 mm long, straight in from (-10, 0, 0) mm, on the patient's left.
ScrewPlan straight() {
  return {Side::kLeft, {{-10 * kMm, 0, 0}}, {{-10 * kMm, -40 * kMm, 0}}, 3 * kMm, "planned so"};
}

TEST(ChangedScrew, MovesAsAWholeAndKeepsWhatItIs) {
  const SurfaceIndex bone = roof();
  const auto moved =
      moved_screw(straight(), ScrewPart::kWhole, ScrewDirection::kCranial, kMm, bone, bone);
  ASSERT_TRUE(moved);
  EXPECT_NEAR((moved->entry.v - Vec3{-10 * kMm, 0, kMm}).norm(), 0.0, kExact);
  EXPECT_NEAR((moved->target.v - Vec3{-10 * kMm, -40 * kMm, kMm}).norm(), 0.0, kExact);
  EXPECT_EQ(moved->radius_m, 3 * kMm);
  EXPECT_EQ(moved->accepted_breach, "planned so");
}

TEST(ChangedScrew, DirectionsAreThePatients) {
  const SurfaceIndex bone = roof();
  const auto x_after = [&](Side side, ScrewDirection direction) {
    ScrewPlan screw = straight();
    screw.side = side;
    return moved_screw(screw, ScrewPart::kWhole, direction, kMm, bone, bone)->entry.v.x + 10 * kMm;
  };
  EXPECT_NEAR(x_after(Side::kLeft, ScrewDirection::kMedial), -kMm, kExact) << "+x is left";
  EXPECT_NEAR(x_after(Side::kLeft, ScrewDirection::kLateral), kMm, kExact);
  EXPECT_NEAR(x_after(Side::kRight, ScrewDirection::kMedial), kMm, kExact);
  const auto caudal =
      moved_screw(straight(), ScrewPart::kWhole, ScrewDirection::kCaudal, kMm, bone, bone);
  EXPECT_NEAR(caudal->entry.v.z, -kMm, kExact);
}

TEST(ChangedScrew, TheEntryGoesOnOnTheBoneAndTheLengthStays) {
  const SurfaceIndex bone = roof();
  const auto moved =
      moved_screw(straight(), ScrewPart::kWhole, ScrewDirection::kLateral, 15 * kMm, bone, bone);
  ASSERT_TRUE(moved);
  EXPECT_NEAR((moved->entry.v - Vec3{5 * kMm, -5 * kMm, 0}).norm(), 0.0, kExact);
  EXPECT_NEAR((moved->target.v - Vec3{5 * kMm, -45 * kMm, 0}).norm(), 0.0, kExact);
  const ScrewDifference difference = difference_of(straight(), *moved);
  EXPECT_NEAR(difference.entry_medial_m, -15 * kMm, kExact);
  EXPECT_NEAR(difference.entry_inward_m, 5 * kMm, kExact);
}

TEST(ChangedScrew, TheEntryAloneKeepsTheAim) {
  const SurfaceIndex bone = roof();
  const auto moved =
      moved_screw(straight(), ScrewPart::kEntry, ScrewDirection::kCranial, 3 * kMm, bone, bone);
  ASSERT_TRUE(moved);
  EXPECT_NEAR((moved->entry.v - Vec3{-10 * kMm, 0, 3 * kMm}).norm(), 0.0, kExact);
  EXPECT_NEAR(screw_length_m(*moved), 40 * kMm, kExact);
  const Vec3 along = (moved->target - moved->entry).normalized();
  EXPECT_NEAR((straight().target - moved->entry).cross(along).norm(), 0.0, kExact)
      << "the axis runs through where the target was";
}

TEST(ChangedScrew, TheTargetAloneKeepsTheEntry) {
  const SurfaceIndex bone = roof();
  const auto moved =
      moved_screw(straight(), ScrewPart::kTarget, ScrewDirection::kCaudal, 3 * kMm, bone, bone);
  ASSERT_TRUE(moved);
  EXPECT_EQ(moved->entry.v, straight().entry.v);
  EXPECT_NEAR(screw_length_m(*moved), 40 * kMm, kExact);
  EXPECT_NEAR(tilt_between_rad(straight(), *moved), std::atan(3.0 / 40.0), kExact);
  EXPECT_LT(moved->target.v.z, 0.0);
}

TEST(ChangedScrew, TiltsAboutItsEntryByWhatIsSaid) {
  const auto tilted = tilted_screw(straight(), ScrewDirection::kCranial, 0.1);
  ASSERT_TRUE(tilted);
  EXPECT_EQ(tilted->entry.v, straight().entry.v);
  EXPECT_NEAR(tilt_between_rad(straight(), *tilted), 0.1, kExact);
  EXPECT_NEAR(difference_of(straight(), *tilted).aim_cranial_rad, 0.1, kExact);
  EXPECT_NEAR(difference_of(straight(), *tilted).aim_medial_rad, 0.0, kExact);
}

TEST(ChangedScrew, IsNoneWhereTheBoneIsNotReached) {
  const SurfaceIndex bone = roof();
  const auto off =
      moved_screw(straight(), ScrewPart::kWhole, ScrewDirection::kCranial, 110 * kMm, bone, bone);
  EXPECT_FALSE(off) << "beside the bone";
  // A pointer can reach the right half; the left one lies in front of it.
  TriangleMesh lower;
  lower.vertices_m = {{-0.1, -0.01, -0.1}, {-0.1, -0.01, 0.1}, {0, -0.01, 0.1}};
  lower.triangles = {{0, 1, 2}};
  EXPECT_FALSE(moved_screw(straight(), ScrewPart::kWhole, ScrewDirection::kCranial, kMm, bone,
                           SurfaceIndex(lower)))
      << "through other bone first";
}

TEST(ChangedScrew, IsNoneForAScrewWithoutDirections) {
  ScrewPlan upright = straight();
  upright.target = upright.entry + Vec3{0, 0, 0.04};
  const SurfaceIndex bone = roof();
  EXPECT_FALSE(moved_screw(upright, ScrewPart::kWhole, ScrewDirection::kMedial, kMm, bone, bone));
  EXPECT_FALSE(tilted_screw(upright, ScrewDirection::kMedial, 0.1));
}

TEST(ChangedScrew, AnotherSizeKeepsEntryAndAxis) {
  const ScrewPlan longer = resized_screw(straight(), 0.0, 45 * kMm);
  EXPECT_EQ(longer.radius_m, 3 * kMm);
  EXPECT_NEAR((longer.target.v - Vec3{-10 * kMm, -45 * kMm, 0}).norm(), 0.0, kExact);
  const ScrewPlan thicker = resized_screw(straight(), 3.5 * kMm, 0.0);
  EXPECT_EQ(thicker.radius_m, 3.5 * kMm);
  EXPECT_EQ(thicker.target.v, straight().target.v);
  const ScrewDifference difference = difference_of(straight(), thicker);
  EXPECT_NEAR(difference.diameter_to_m - difference.diameter_from_m, kMm, kExact);
  EXPECT_EQ(difference.entry_cranial_m, 0.0);
  EXPECT_EQ(difference.entry_medial_m, 0.0);
  EXPECT_EQ(difference.entry_inward_m, 0.0);
}

}  // namespace
}  // namespace orthonav::nav::changed_screw_test
