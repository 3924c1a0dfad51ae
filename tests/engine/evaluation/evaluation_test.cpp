#include "engine/evaluation/evaluation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/angle.h"
#include "tests/engine/evaluation/operated_phantom.h"

namespace orthonav::engine::evaluation_test {
namespace {

using ::testing::HasSubstr;

/// One draw each at voxels of 0.8 and 1 mm; distributions are measured by bench_evaluation.
constexpr double kAxis_mm = 0.4;
constexpr double kAxis_deg = 0.5;

/// L4 of the phantom, operated and scanned once.
struct Operated {
  Case subject = phantom({"L4"});
  test::OperatedSpine spine;
  Volume scan;
};

const Operated& operated_l4() {
  static const Operated operated = [] {
    Operated out;
    out.spine = test::operated(out.subject, {}, Random(11));
    out.scan = test::quick_scan(out.spine);
    return out;
  }();
  return operated;
}

double off_axis_mm(const nav::ScrewCylinder& axis, Vec3 place_m) {
  return 1e3 * (place_m - axis.entry.v).cross(axis.direction).norm();
}

void expect_true(const test::TrueScrew& truth, const EvaluatedScrew& found) {
  ASSERT_TRUE(found.placed.has_value());
  const nav::ScrewCylinder& axis = found.placed->cylinder;
  EXPECT_LT(off_axis_mm(axis, truth.entry_m), kAxis_mm);
  EXPECT_LT(off_axis_mm(axis, truth.tip_m), kAxis_mm);
  const Vec3 direction = truth.tip_m - truth.entry_m;
  EXPECT_LT(angle_between_rad(direction, axis.direction) * kDegreesPerRadian, kAxis_deg);
  EXPECT_NEAR(found.placed->depth_m,
              direction.norm() - (found.plan.target - found.plan.entry).norm(), 0.0006);
  // As far off the plan as in truth, by either definition of the entry.
  EXPECT_NEAR(
      found.placed->angle_rad * kDegreesPerRadian,
      angle_between_rad(direction, found.plan.target - found.plan.entry) * kDegreesPerRadian,
      kAxis_deg);
  EXPECT_NEAR(found.placed->entry_m * 1e3, (truth.entry_m - found.plan.entry.v).norm() * 1e3,
              2.0 * kAxis_mm);
  EXPECT_LE(found.placed->entry_axis_m, found.placed->entry_m + 1e-9);
}

TEST(Evaluation, FindsScrewsWhereTheyTrulyLie) {
  const auto found = evaluate(operated_l4().subject, operated_l4().scan);
  ASSERT_TRUE(found.ok()) << found.error().message;
  ASSERT_EQ(found->levels.size(), 1u);
  ASSERT_TRUE(found->levels[0].registration.has_value()) << found->levels[0].refusal;
  const test::Motion& truth = operated_l4().spine.bones[0].scanner_from_model;
  const auto& pose = found->levels[0].registration->scan_from_vertebra;
  EXPECT_LT((pose.translation() - truth.translation_m).norm(), 0.0003);
  EXPECT_LT(rotation_angle_rad(pose.rotation(), truth.rotation) * kDegreesPerRadian, 0.3);
  ASSERT_EQ(found->levels[0].screws.size(), 2u);
  for (const test::TrueScrew& screw : operated_l4().spine.screws) {
    expect_true(screw, found->levels[0].screws[screw.screw]);
  }
  EXPECT_TRUE(found->unassigned.empty()) << "heads belong to their screws";
}

TEST(Evaluation, JudgesMetalThatLooksThinnerThanPlannedAsPlannedToo) {
  constexpr double kThicker_m = 0.0005;
  Case subject = operated_l4().subject;
  for (nav::ScrewPlan& plan : subject.levels[0].screws) {
    plan.radius_m += kThicker_m;
  }
  const auto found = evaluate(subject, operated_l4().scan);
  ASSERT_TRUE(found.ok());
  for (const EvaluatedScrew& screw : found->levels[0].screws) {
    ASSERT_TRUE(screw.placed && screw.placed->clearance && screw.placed->as_planned_screw);
    EXPECT_NEAR(screw.placed->as_planned_screw->clearance_m,
                screw.placed->clearance->clearance_m - kThicker_m, 0.0002);
  }
  const auto as_planned = evaluate(operated_l4().subject, operated_l4().scan);
  ASSERT_TRUE(as_planned.ok());
  EXPECT_FALSE(as_planned->levels[0].screws[0].placed->as_planned_screw);
}

TEST(Evaluation, GradesByTheSurfaceOfTheScrewFromSixMillimetresOn) {
  const auto found = evaluate(operated_l4().subject, operated_l4().scan);
  ASSERT_TRUE(found.ok());
  const nav::SurfaceIndex bone(operated_l4().subject.levels[0].mesh);
  for (const test::TrueScrew& truth : operated_l4().spine.screws) {
    const Vec3 way = truth.tip_m - truth.entry_m;
    const auto least =
        nav::least_clearance(bone, {{truth.entry_m}, way.normalized(), way.norm(), truth.radius_m});
    const auto& placed = found->levels[0].screws[truth.screw].placed;
    ASSERT_TRUE(least && placed && placed->clearance && placed->spread);
    EXPECT_NEAR(placed->clearance->clearance_m, least->clearance_m, 0.0004);
    EXPECT_LT(placed->spread->lower_95_m, placed->clearance->clearance_m);
    EXPECT_TRUE(placed->radius_as_planned) << placed->measured_radius_m;
    EXPECT_DOUBLE_EQ(placed->cylinder.radius_m, truth.radius_m);
  }
}

TEST(Evaluation, NamesEachGradeThatIsLikely) {
  using nav::PedicleGrade;
  ScrewInScan screw;
  EXPECT_TRUE(likely_grades(screw).empty()) << "no clearance";
  screw.clearance = nav::Clearance{-0.00195};
  screw.spread = nav::ClearanceSpread{-0.0022, {0.0, 0.95, 0.05, 0.0, 0.0}};
  EXPECT_EQ(likely_grades(screw), std::vector{PedicleGrade::kB}) << "firm";
  screw.spread->grade_probability = {0.0, 0.4, 0.6, 0.0, 0.0};
  EXPECT_EQ(likely_grades(screw), (std::vector{PedicleGrade::kB, PedicleGrade::kC}));
  screw.spread->grade_probability = {0.0, 0.05, 0.95, 0.0, 0.0};
  EXPECT_EQ(likely_grades(screw), (std::vector{PedicleGrade::kB, PedicleGrade::kC}))
      << "the measured one is always among them";
}

TEST(Evaluation, InventsNoScrewAndReportsWhatLiesElsewhere) {
  // The left screw is missing; another one was driven askew through the body's side.
  test::OperatedSpine spine = operated_l4().spine;
  const test::Motion& pose = spine.bones[0].scanner_from_model;
  const nav::ScrewPlan& left = operated_l4().subject.levels[0].screws[0];
  ASSERT_EQ(left.side, Side::kLeft);
  std::erase_if(spine.metal, [&](const test::MetalPiece& piece) {
    return (piece.to_m - pose(left.target.v)).norm() < 0.015 ||
           (piece.to_m - pose(left.entry.v)).norm() < 0.015;
  });
  ASSERT_EQ(spine.metal.size(), 2u) << "shaft and head of the right one";
  const Vec3 front = left.target.v + Vec3{0.004, 0.0, 0.002};
  spine.metal.push_back({pose(front + Vec3{0.030, 0.004, 0.0}), pose(front), 0.0025});
  const auto found = evaluate(operated_l4().subject, test::quick_scan(spine));
  ASSERT_TRUE(found.ok()) << found.error().message;
  ASSERT_TRUE(found->levels[0].registration.has_value()) << found->levels[0].refusal;
  EXPECT_FALSE(found->levels[0].screws[0].placed.has_value());
  EXPECT_TRUE(found->levels[0].screws[1].placed.has_value()) << "the twin";
  ASSERT_EQ(found->unassigned.size(), 1u);
  ASSERT_TRUE(found->unassigned[0].shaft.has_value());
  EXPECT_NEAR(found->shafts[*found->unassigned[0].shaft].length_m(), 0.030, 0.0015);
}

TEST(Evaluation, RefusesAVertebraThatTheScanDoesNotHold) {
  Case subject = phantom({"L3", "L4"});
  const auto found = evaluate(subject, operated_l4().scan);
  ASSERT_TRUE(found.ok()) << found.error().message;
  ASSERT_EQ(found->levels.size(), 2u);
  EXPECT_FALSE(found->levels[0].registration.has_value());
  EXPECT_THAT(found->levels[0].refusal, HasSubstr("of the vertebra lie in the scan, limit 60 %"));
  EXPECT_FALSE(found->levels[0].screws[0].placed.has_value());
  EXPECT_TRUE(found->levels[1].registration.has_value()) << found->levels[1].refusal;
}

TEST(Evaluation, RefusesAnotherVertebrasBone) {
  for (const char* label : {"L3", "L5"}) {
    Case subject = phantom({label});
    subject.levels[0].spine_from_vertebra = operated_l4().subject.levels[0].spine_from_vertebra;
    const auto found = evaluate(subject, operated_l4().scan);
    if (found.ok()) {
      EXPECT_FALSE(found->levels[0].registration.has_value())
          << label << " " << found->levels[0].registration->residual_m;
      EXPECT_THAT(found->levels[0].refusal, HasSubstr("another vertebra, or a coarse model"));
      EXPECT_FALSE(found->levels[0].screws[0].placed.has_value());
    } else {
      EXPECT_THAT(found.error().message, HasSubstr("in two places nearly alike"));
    }
  }
}

TEST(Evaluation, RefusesACaseWithoutAPlan) {
  Case subject = phantom({"L4"});
  subject.levels[0].screws.clear();
  const auto found = evaluate(subject, operated_l4().scan);
  ASSERT_FALSE(found.ok());
  EXPECT_THAT(found.error().message, HasSubstr("no planned screw"));
}

}  // namespace
}  // namespace orthonav::engine::evaluation_test
