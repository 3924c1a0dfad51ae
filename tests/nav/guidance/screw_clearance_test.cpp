#include "nav/guidance/screw_clearance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "nav/geometry/surface_depth.h"
#include "tests/support/allocation_count.h"
#include "tests/support/anatomy.h"
#include "tests/support/mesh_builder.h"

namespace orthonav::nav::screw_clearance_test {
namespace {

/// The search narrows to 4 µm; on a plane there is no other error.
constexpr double kSearch_m = 5e-6;
/// What `least_clearance` promises by default.
constexpr double kTolerance_m = 0.00005;
constexpr double kSide_m = 0.0005;  ///< distance of the values tried on either side of a limit
/// A box of 20 × 60 × 30 mm; +y is behind.
const SurfaceIndex& box() {
  static const SurfaceIndex kBox(test::box({-0.010, -0.040, -0.015}, {0.010, 0.020, 0.015}));
  return kBox;
}

/// 45 mm straight into the box from behind, at this place.
ScrewCylinder straight_in(double x, double z, double radius_m = 0.003) {
  return {{{x, 0.020, z}}, {0, -1, 0}, 0.045, radius_m};
}

/// A closed tube with `sides` sides about the y axis, 80 mm long: a bone that is all pedicle.
TriangleMesh tube(double radius_m, std::uint32_t sides) {
  TriangleMesh mesh;
  for (const double y : {-0.040, 0.040}) {
    for (std::uint32_t k = 0; k < sides; ++k) {
      const double a = 2.0 * std::numbers::pi * k / sides;
      mesh.vertices_m.push_back({radius_m * std::sin(a), y, radius_m * std::cos(a)});
    }
  }
  mesh.vertices_m.push_back({0, -0.040, 0});
  mesh.vertices_m.push_back({0, 0.040, 0});
  for (std::uint32_t k = 0; k < sides; ++k) {
    const std::uint32_t next = (k + 1) % sides;
    mesh.triangles.push_back({k, sides + k, next});
    mesh.triangles.push_back({next, sides + k, sides + next});
    mesh.triangles.push_back({2 * sides, k, next});
    mesh.triangles.push_back({2 * sides + 1, sides + next, sides + k});
  }
  const Vec3 v = mesh.vertices_m[0];
  const auto& t = mesh.triangles[0];
  const Vec3 normal = (mesh.vertices_m[t[1]] - v).cross(mesh.vertices_m[t[2]] - v);
  if (normal.dot(v) < 0.0) {
    for (auto& face : mesh.triangles) {
      std::swap(face[1], face[2]);
    }
  }
  return mesh;
}

TEST(ScrewClearance, IsTheDistanceToTheNearestWallOfABox) {
  for (const double x : {0.0, 0.002, 0.0055, 0.0069}) {
    const auto found = least_clearance(box(), straight_in(x, 0.0));
    ASSERT_TRUE(found.has_value());
    // From 6 mm past the entry on, the back is 6 mm away.
    EXPECT_NEAR(found->clearance_m, std::min(0.006, 0.010 - x - 0.003), kSearch_m);
    EXPECT_FALSE(found->on_tip);
    EXPECT_EQ(grade_of(found->clearance_m), PedicleGrade::kA);
  }
}

TEST(ScrewClearance, SaysWhereItIs) {
  const auto right = least_clearance(box(), straight_in(-0.005, 0.0));
  EXPECT_LT(right->outward.x, -0.99);
  EXPECT_STREQ(direction_of(*right, Side::kRight), "lateral");
  EXPECT_STREQ(direction_of(*right, Side::kLeft), "medial");
  EXPECT_NEAR(right->place.v.x, -0.008, kSearch_m);
  const auto above = least_clearance(box(), straight_in(0.0, 0.011));
  EXPECT_STREQ(direction_of(*above, Side::kLeft), "cranial");
  const auto below = least_clearance(box(), straight_in(0.0, -0.011));
  EXPECT_STREQ(direction_of(*below, Side::kLeft), "caudal");
}

TEST(ScrewClearance, CountsTheTipAndNotTheFirstSixMillimetres) {
  ScrewCylinder screw = straight_in(0.0, 0.0);
  screw.length_m = 0.058;  // 2 mm from the front
  const auto tip = least_clearance(box(), screw);
  EXPECT_NEAR(tip->clearance_m, 0.002, kSearch_m);
  EXPECT_STREQ(direction_of(*tip, Side::kLeft), "tip");
  screw.length_m = 0.0615;
  EXPECT_NEAR(least_clearance(box(), screw)->clearance_m, -0.0015, kSearch_m);
  // The entry lies on the surface, where every depth is 0; 6 mm farther the depth is 6 mm.
  const ScrewCylinder thin = straight_in(0.0, 0.0, 0.001);
  EXPECT_NEAR(least_clearance(box(), thin)->clearance_m, 0.006, kSearch_m);
  EXPECT_NEAR(least_clearance(box(), thin)->arc_length_m, 0.006, kSearch_m);
}

TEST(ScrewClearance, OfACylinderInATubeIsTheDifferenceOfTheRadii) {
  constexpr std::uint32_t kSides = 96;
  const SurfaceIndex bone(tube(0.005, kSides));
  // Between its corners a polygon is nearer by this.
  const double sagitta_m = 0.005 * (1.0 - std::cos(std::numbers::pi / kSides));
  for (const double aside_m : {0.0, 0.0007, 0.0015}) {
    const ScrewCylinder screw{{{aside_m, 0.030, 0.0}}, {0, -1, 0}, 0.045, 0.003};
    EXPECT_NEAR(least_clearance(bone, screw)->clearance_m, 0.002 - aside_m,
                kTolerance_m + sagitta_m);
  }
  // Tilted by 2° about the tube's middle: the ends come nearer by half the length times the sine.
  const double tilt_rad = 2.0 * std::numbers::pi / 180.0;
  const Vec3 inward{std::sin(tilt_rad), -std::cos(tilt_rad), 0.0};
  const ScrewCylinder tilted{{-0.0225 * inward}, inward, 0.045, 0.003};
  const double end_m = 0.0225 * std::sin(tilt_rad) + 0.003 * std::cos(tilt_rad);
  EXPECT_NEAR(least_clearance(bone, tilted)->clearance_m, 0.005 - end_m, kTolerance_m + sagitta_m);
}

TEST(ScrewClearance, OfAScrewThatLeavesTheBoneIsTheLargestBreach) {
  for (const double out_m : {0.0003, 0.0019, 0.0021, 0.0039, 0.0041, 0.0059}) {
    const auto found = least_clearance(box(), straight_in(0.007 + out_m, 0.0));
    EXPECT_NEAR(found->clearance_m, -out_m, kTolerance_m);
  }
}

TEST(PedicleGrade, ChangesAtTwoFourAndSixMillimetres) {
  EXPECT_EQ(grade_of(0.0), PedicleGrade::kA);
  EXPECT_EQ(grade_of(0.010), PedicleGrade::kA);
  EXPECT_EQ(grade_of(-1e-9), PedicleGrade::kB);
  EXPECT_EQ(grade_of(-0.002 + 1e-9), PedicleGrade::kB);
  EXPECT_EQ(grade_of(-0.002), PedicleGrade::kC);
  EXPECT_EQ(grade_of(-0.004 + 1e-9), PedicleGrade::kC);
  EXPECT_EQ(grade_of(-0.004), PedicleGrade::kD);
  EXPECT_EQ(grade_of(-0.006 + 1e-9), PedicleGrade::kD);
  EXPECT_EQ(grade_of(-0.006), PedicleGrade::kE);
  EXPECT_EQ(grade_of(std::nan("")), PedicleGrade::kE) << "what nobody knows is not good";
  EXPECT_STREQ(name_of(PedicleGrade::kD), "D");
}

TEST(PedicleGrade, OfAScrewBesideAWallChangesWhereItsBreachDoes) {
  const auto grade = [](double breach_m) {
    return grade_of(least_clearance(box(), straight_in(0.007 + breach_m, 0.0))->clearance_m);
  };
  EXPECT_EQ(grade(-kSide_m), PedicleGrade::kA);
  EXPECT_EQ(grade(kSide_m), PedicleGrade::kB);
  EXPECT_EQ(grade(0.002 - kSide_m), PedicleGrade::kB);
  EXPECT_EQ(grade(0.002 + kSide_m), PedicleGrade::kC);
  EXPECT_EQ(grade(0.004 - kSide_m), PedicleGrade::kC);
  EXPECT_EQ(grade(0.004 + kSide_m), PedicleGrade::kD);
  EXPECT_EQ(grade(0.006 - kSide_m), PedicleGrade::kD);
  EXPECT_EQ(grade(0.006 + kSide_m), PedicleGrade::kE);
}

TEST(ScrewClearance, IsAbsentWhereThereIsNoScrewOrNoBone) {
  ScrewCylinder stub = straight_in(0.0, 0.0);
  stub.length_m = 0.006;
  EXPECT_FALSE(least_clearance(box(), stub).has_value());
  EXPECT_FALSE(least_clearance(SurfaceIndex(TriangleMesh{}), straight_in(0, 0)).has_value());
  const ScrewPlan plan{Side::kLeft, {{0, 0.02, 0}}, {{0, -0.02, 0}}, 0.0};
  EXPECT_FALSE(cylinder_of(plan).has_value()) << "no radius is stated";
  ScrewPlan lost = plan;
  lost.radius_m = 0.003;
  lost.target.v.x = std::nan("");
  EXPECT_FALSE(cylinder_of(lost).has_value());
}

TEST(ScrewCylinder, AlongAToolEntersWhereItsAxisMeetsTheBone) {
  const ScrewPlan plan{Side::kLeft, {{0, 0.020, 0}}, {{0, -0.025, 0}}, 0.003};
  for (const double tip_y : {0.050, 0.020, 0.000, -0.020}) {
    const auto screw = cylinder_along({{{0.004, tip_y, 0.001}}, {0, -2, 0}}, plan, box());
    ASSERT_TRUE(screw.has_value()) << tip_y;
    EXPECT_LT((screw->entry - Point<Vertebra>{{0.004, 0.020, 0.001}}).norm(), 1e-12);
    EXPECT_NEAR(screw->length_m, 0.045, 1e-12);
  }
  EXPECT_FALSE(cylinder_along({{{0.012, 0.02, 0}}, {0, -1, 0}}, plan, box()).has_value());
  EXPECT_FALSE(cylinder_along({{{0.0, 0.02, 0}}, {0, 0, 0}}, plan, box()).has_value());
}

TEST(ClearanceProfile, FollowsAWallThatComesNearer) {
  const double slope = 0.04;
  const Vec3 inward = Vec3{slope, -1.0, 0.0}.normalized();
  const ScrewCylinder screw{{{0.0, 0.020, 0.0}}, inward, 0.045, 0.003};
  std::vector<double> profile(14);
  ASSERT_TRUE(clearance_profile(box(), screw, profile));
  for (std::size_t i = 0; i < profile.size(); ++i) {
    const double arc_m = 0.006 + 0.039 * static_cast<double>(i) / 13.0;
    const double wall_m = 0.010 - arc_m * inward.x + 0.003 * inward.y;
    const double back_m = arc_m * -inward.y - 0.003 * inward.x;
    EXPECT_NEAR(profile[i], std::min(wall_m, back_m), 0.00002) << "rims are looked at every 10°";
  }
  std::vector<double> none;
  EXPECT_FALSE(clearance_profile(box(), screw, none));
}

/// Brute force: every place of a fine grid, with other rays than the probe's.
double by_brute_force(const TriangleMesh& mesh, const ScrewCylinder& screw) {
  const SurfaceIndex bone(mesh);
  const auto surface = *CylinderSurface::of(screw);
  double least_m = 1e9;
  constexpr int kAlong = 170;
  constexpr int kAround = 72;
  for (int i = 0; i <= kAlong; ++i) {
    for (int k = 0; k < kAround; ++k) {
      const Vec3 place =
          surface.at(surface.length_m() * i / kAlong, 2.0 * std::numbers::pi * k / kAround).v;
      const double distance_m = bone.nearest(place)->distance_m;
      const double side = bone.contains(place) ? 1.0 : -1.0;
      least_m = std::min(least_m, side * distance_m);
    }
  }
  return least_m;
}

TEST(ScrewClearance, OnRealVertebraeIsWhatBruteForceFinds) {
  Random random(5);
  int breaches = 0;
  for (const test::AnatomyLevel& level : test::sampled_anatomy_levels()) {
    const SurfaceIndex bone(level.mesh);
    for (ScrewPlan plan : level.screws) {
      const auto planned = least_clearance(bone, *cylinder_of(plan));
      EXPECT_GE(planned->clearance_m, 0.0009) << level.name << ": as its README says";
      for (const double off_m : {0.0, 0.003}) {
        plan.entry.v += off_m * Vec3{random.normal(), 0.0, random.normal()};
        plan.target.v += off_m * Vec3{random.normal(), random.normal(), random.normal()};
        const auto screw = *cylinder_of(plan);
        const Clearance found = *least_clearance(bone, screw);
        const double least_m = found.clearance_m;
        EXPECT_LT(least_m, by_brute_force(level.mesh, screw) + kTolerance_m) << level.name;
        // It is not below the true one: there is a place of the screw with that depth.
        const Vec3 aside = found.place.v - screw.entry.v;
        EXPECT_LT(aside.cross(screw.direction).norm(), screw.radius_m + 1e-12);
        const double side = bone.contains(found.place.v) ? 1.0 : -1.0;
        EXPECT_NEAR(bone.nearest(found.place.v)->distance_m, side * least_m, 1e-12);
        breaches += least_m < 0.0 ? 1 : 0;
      }
    }
  }
  EXPECT_GT(breaches, 2) << "both signs are tried";
}

TEST(ScrewClearance, StandsASmallDefectOfTheMesh) {
  const auto level = test::anatomy_level("shape-mean/L3");
  if (!level) {
    GTEST_SKIP() << "needs shared/anatomy";
  }
  const auto screw = *cylinder_of(level->screws[0]);
  const auto whole = *least_clearance(SurfaceIndex(level->mesh), screw);
  // A flipped face, and a missing one, far from the screw and beside it.
  for (const std::size_t face : {std::size_t{0}, level->mesh.triangles.size() / 2}) {
    TriangleMesh inverted = level->mesh;
    std::swap(inverted.triangles[face][0], inverted.triangles[face][1]);
    EXPECT_NEAR(least_clearance(SurfaceIndex(inverted), screw)->clearance_m, whole.clearance_m,
                kTolerance_m);
    TriangleMesh open = level->mesh;
    open.triangles.erase(open.triangles.begin() + static_cast<std::ptrdiff_t>(face));
    EXPECT_NEAR(least_clearance(SurfaceIndex(open), screw)->clearance_m, whole.clearance_m,
                kTolerance_m);
  }
}

TEST(ScrewClearance, AllocatesNothing) {
  (void)least_clearance(box(), straight_in(0.001, 0.0));
  const std::size_t before = test::allocation_count();
  const auto found = least_clearance(box(), straight_in(0.002, 0.001));
  EXPECT_EQ(test::allocation_count() - before, 0u);
  EXPECT_TRUE(found.has_value());
}

TEST(DepthProbe, KnowsTheWayInFromTheSurfaceItself) {
  DepthProbe probe(box());
  for (const double off_m : {0.0, 1e-17, -1e-17, 1e-12}) {
    const auto found = probe.at({0.010 + off_m, 0.0003, 0.0001});
    EXPECT_NEAR(found->depth_m, 0.0, 1e-11);
    EXPECT_LT((found->deeper - Vec3{-1, 0, 0}).norm(), 1e-12);
  }
}

TEST(DepthProbe, GivesTheSameInAnyOrder) {
  const SurfaceIndex bone(test::sphere({0, 0, 0}, 0.02, 40));
  DepthProbe warm(bone);
  Random random(3);
  for (int i = 0; i < 500; ++i) {
    const Vec3 place{random.normal(0, 0.015), random.normal(0, 0.015), random.normal(0, 0.015)};
    DepthProbe fresh(bone);
    const auto expected = fresh.at(place);
    const auto found = warm.at(place);
    EXPECT_EQ(found->depth_m, expected->depth_m);
    EXPECT_EQ(found->depth_m > 0.0, bone.contains(place));
    // Facets of 4.5° lie 0.02 mm below the ball.
    EXPECT_NEAR(found->depth_m, 0.02 - place.norm(), 0.0001);
    EXPECT_LT((found->deeper + place.normalized()).norm(), 0.2);
  }
  EXPECT_FALSE(warm.at({std::nan(""), 0, 0}).has_value());
}

}  // namespace
}  // namespace orthonav::nav::screw_clearance_test
