#include "nav/planning/pedicle_screws.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "base/random.h"
#include "engine/phantom/phantom.h"
#include "tests/support/anatomy.h"
#include "tests/support/mesh_builder.h"

namespace orthonav::nav::pedicle_screws_test {
namespace {

using ::testing::HasSubstr;

/// The built-in sizes, or some of their diameters.
std::vector<ImplantSize> sizes(std::vector<double> diameters_mm = {4.5, 5.0, 5.5, 6.0, 6.5, 7.0}) {
  std::vector<ImplantSize> out;
  for (const double diameter_mm : diameters_mm) {
    for (int length_mm = 25; length_mm <= 60; length_mm += 5) {
      out.push_back({diameter_mm * 1e-3, length_mm * 1e-3});
    }
  }
  return out;
}

struct Bone {
  explicit Bone(TriangleMesh m) : mesh(std::move(m)), surface(mesh) {}
  TriangleMesh mesh;
  SurfaceIndex surface;
};

const Bone& phantom_l4() {
  static const Bone bone(engine::phantom({"L4"}).levels.front().mesh);
  return bone;
}

double clearance_m(const SurfaceIndex& bone, const ScrewPlan& plan) {
  return least_clearance(bone, cylinder_of(plan).value()).value().clearance_m;
}

TEST(PedicleScrews, AreInsideAndMirrorEachOtherInASymmetricBone) {
  const auto planned = plan_pedicle_screws(phantom_l4().mesh, phantom_l4().surface, sizes());
  ASSERT_TRUE(planned.ok()) << planned.error().message;
  ASSERT_TRUE(planned->sides[0].ok());
  ASSERT_TRUE(planned->sides[1].ok());
  const PlannedScrew& left = *planned->sides[0];
  const PlannedScrew& right = *planned->sides[1];
  for (const PlannedScrew* screw : {&left, &right}) {
    EXPECT_EQ(grade_of(screw->clearance.clearance_m), PedicleGrade::kA);
    EXPECT_NEAR(screw->clearance.clearance_m, clearance_m(phantom_l4().surface, screw->plan), 1e-9);
    EXPECT_LT(phantom_l4().surface.nearest(screw->plan.entry.v)->distance_m, 1e-9);
    EXPECT_GE(screw->before_front_m, 0.005) << "the safe depth";
  }
  EXPECT_EQ(left.plan.side, Side::kLeft);
  EXPECT_GT(left.plan.entry.v.x, 0.0);
  EXPECT_EQ(left.plan.radius_m, right.plan.radius_m);
  EXPECT_NEAR((left.plan.target - left.plan.entry).norm(),
              (right.plan.target - right.plan.entry).norm(), 1e-9);
  EXPECT_NEAR(left.clearance.clearance_m, right.clearance.clearance_m, 0.0001);
  EXPECT_NEAR(left.convergence_rad, right.convergence_rad, 2.0 * kRadiansPerDegree);
  EXPECT_NEAR(left.cranial_rad, right.cranial_rad, 2.0 * kRadiansPerDegree);
}

TEST(PedicleScrews, LeaveNoBetterOneOfThatSizeToChance) {
  // The clearance sacrificed for usual angles: 0.01 mm per degree in the search, and the grid's
  // step.
  constexpr double kGivenUp_m = 0.0003;
  const SurfaceIndex& bone = phantom_l4().surface;
  const auto planned = plan_pedicle_screws(phantom_l4().mesh, bone, sizes());
  const PlannedScrew& left = *planned->sides[0];
  const double length_m = (left.plan.target - left.plan.entry).norm();
  const PedicleSearch search(bone, planned->canal, PlanningRules{}.steepest_rad);
  Random random(25);
  double best_m = -1.0;
  for (int i = 0; i < 2000; ++i) {
    const PedicleAxis axis{random.uniform(0.010, 0.030), random.uniform(-0.010, 0.012),
                           random.uniform(0.0, 0.7), random.uniform(-0.3, 0.3)};
    const auto way = search.way(Side::kLeft, axis);
    if (!way || PedicleSearch::safe_length_m(*way) < length_m) {
      continue;
    }
    const auto clearance =
        least_clearance(bone, {way->entry, way->direction, length_m, left.plan.radius_m});
    best_m = std::max(best_m, clearance ? clearance->clearance_m : -1.0);
  }
  EXPECT_LT(best_m, left.clearance.clearance_m + kGivenUp_m);
  EXPECT_GT(best_m, left.clearance.clearance_m - 0.001) << "chance came near: the twin";
}

TEST(PedicleScrews, AreTheThickestThatLeaveWhatIsWanted) {
  const auto diameter_mm = [](const PlanningRules& rules) {
    const auto planned =
        plan_pedicle_screws(phantom_l4().mesh, phantom_l4().surface, sizes(), rules);
    return 2e3 * planned->sides[0]->plan.radius_m;
  };
  // The pedicle has room for 13.5 to 14 mm.
  EXPECT_NEAR(diameter_mm({0.001, 0.0065}), 6.5, 1e-9);
  EXPECT_NEAR(diameter_mm({0.001, 0.0080}), 7.0, 1e-9) << "the list ends there";
  EXPECT_NEAR(diameter_mm({0.0041, 0.0065}), 5.0, 1e-9);
  EXPECT_NEAR(diameter_mm({0.0060, 0.0065}), 4.5, 1e-9) << "none leaves that: the thinnest";
}

TEST(PedicleScrews, AreRefusedWhereThePedicleIsTooNarrow) {
  PlanningRules rules;
  rules.thickest_m = 0.020;
  const auto narrow =
      plan_pedicle_screws(phantom_l4().mesh, phantom_l4().surface, sizes({14.5}), rules);
  ASSERT_TRUE(narrow.ok());
  for (const auto& side : narrow->sides) {
    ASSERT_FALSE(side.ok());
    EXPECT_THAT(side.error().message, HasSubstr("pedicle too narrow: room for a screw of 13."));
    EXPECT_THAT(side.error().message, HasSubstr("14.5 mm"));
  }
  const auto wide =
      plan_pedicle_screws(phantom_l4().mesh, phantom_l4().surface, sizes({13.5}), rules);
  EXPECT_TRUE(wide->sides[0].ok()) << "the twin";
}

TEST(PedicleScrews, AreRefusedWhereNoLengthReachesTheBodyAndEndsSafely) {
  const std::vector<ImplantSize> list = {{0.0055, 0.025}, {0.0055, 0.060}};
  const auto planned = plan_pedicle_screws(phantom_l4().mesh, phantom_l4().surface, list);
  ASSERT_FALSE(planned->sides[0].ok());
  EXPECT_THAT(planned->sides[0].error().message, HasSubstr("no length in the list suits"));
}

TEST(PedicleScrews, FollowAVertebraThatIsTiltedInItsScan) {
  constexpr double kSame_m = 0.0003;  // both searches sacrifice a little
  const auto upright = plan_pedicle_screws(phantom_l4().mesh, phantom_l4().surface, sizes());
  const TriangleMesh mesh = test::rotated(
      phantom_l4().mesh, rotation_from_vector(-30.0 * kRadiansPerDegree * Vec3{1, 0, 0}));
  const auto tilted = plan_pedicle_screws(mesh, SurfaceIndex(mesh), sizes());
  ASSERT_TRUE(tilted.ok());
  ASSERT_TRUE(tilted->sides[0].ok()) << tilted->sides[0].error().message;
  EXPECT_NEAR(tilted->sides[0]->clearance.clearance_m, upright->sides[0]->clearance.clearance_m,
              kSame_m);
}

TEST(PedicleScrews, RefuseWhatIsNoVertebraAndAnEmptyList) {
  const TriangleMesh ball = test::sphere({}, 0.03, 20);
  const auto none = plan_pedicle_screws(ball, SurfaceIndex(ball), sizes());
  ASSERT_FALSE(none.ok());
  EXPECT_THAT(none.error().message, HasSubstr("no vertebral canal found"));
  const auto empty = plan_pedicle_screws(phantom_l4().mesh, phantom_l4().surface, sizes({7.0}));
  ASSERT_FALSE(empty.ok());
  EXPECT_THAT(empty.error().message, HasSubstr("has none up to 6.5 mm"));
}

TEST(PedicleScrews, AreOfGradeAOnEveryRealVertebra) {
  const auto levels = test::anatomy_levels();
  if (levels.empty()) {
    GTEST_SKIP() << "needs shared/anatomy";
  }
  for (const test::AnatomyLevel& level : levels) {
    const SurfaceIndex bone(level.mesh);
    const auto planned = plan_pedicle_screws(level.mesh, bone, sizes());
    ASSERT_TRUE(planned.ok()) << level.name << ": " << planned.error().message;
    for (const auto& side : planned->sides) {
      ASSERT_TRUE(side.ok()) << level.name << ": " << side.error().message;
      EXPECT_EQ(grade_of(clearance_m(bone, side->plan)), PedicleGrade::kA) << level.name;
      EXPECT_GE(side->plan.radius_m, 0.00225) << level.name;
      EXPECT_GE((side->plan.target - side->plan.entry).norm(), 0.035 - 1e-9) << level.name;
    }
  }
}

}  // namespace
}  // namespace orthonav::nav::pedicle_screws_test
