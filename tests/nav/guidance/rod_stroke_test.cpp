#include "nav/guidance/rod_stroke.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "base/random.h"

namespace orthonav::nav::rod_stroke_test {
namespace {

using ::testing::HasSubstr;

constexpr double kLength_m = 0.16;
constexpr double kDiameter_m = 0.0055;

/// A stroke from end to end on the rod's surface, with the rod in an arbitrary pose. Sides: the
/// angles about the axis along which the tip runs, one pass after the other, there and back.
std::vector<Vec3> stroke(const std::vector<RodArc>& arcs, double noise_m,
                         const std::vector<double>& sides_rad, double from_m = 0.0,
                         double to_m = kLength_m) {
  Random random(11);
  const Mat3 room_from_rod = rotation_from_vector({1.1, -2.0, 0.4});
  constexpr int kPoints = 200;
  std::vector<Vec3> points;
  for (const double at : sides_rad) {
    for (int i = 0; i < kPoints; ++i) {
      const double along_m = from_m + (to_m - from_m) * (i + 0.5) / kPoints;
      // The axis from very short arcs of its own, with the frame transported along it.
      std::vector<RodArc> until;
      for (RodArc arc : arcs) {
        const double begin_m = arc.centre_m - 0.5 * arc.width_m;
        if (along_m <= begin_m) {
          break;
        }
        const double part = std::min(1.0, (along_m - begin_m) / arc.width_m);
        until.push_back({begin_m + 0.5 * part * arc.width_m, part * arc.width_m,
                         part * arc.angle_rad, arc.roll_rad});
      }
      const RodStraight here = rod_straights(until, along_m).back();
      Mat3 frame = Mat3::identity();
      for (const RodArc& arc : until) {
        const Vec3 towards{std::cos(arc.roll_rad), std::sin(arc.roll_rad), 0.0};
        frame = frame * rotation_from_vector(arc.angle_rad * Vec3{0, 0, 1}.cross(towards));
      }
      const Vec3 out = frame * Vec3{std::cos(at), std::sin(at), 0.0};
      const Vec3 at_m =
          here.from_m + (along_m - here.begin_m) * here.direction + 0.5 * kDiameter_m * out;
      const Vec3 noise{random.normal(0, noise_m), random.normal(0, noise_m),
                       random.normal(0, noise_m)};
      points.push_back(room_from_rod * at_m + Vec3{0.3, -0.1, 0.7} + noise);
    }
  }
  return points;
}

/// Three passes, a third of a turn apart.
std::vector<double> around(double first_rad) {
  constexpr double kThird_rad = 2.0 * std::numbers::pi / 3.0;
  return {first_rad, first_rad + kThird_rad, first_rad + 2.0 * kThird_rad};
}

/// For points without errors.
RodStrokeRules exact_points() {
  RodStrokeRules rules;
  rules.tip_sd_m = 0.0002;
  return rules;
}

const std::vector<RodArc> kTwoBends = {{0.045, 0.02, 0.24, 0.0}, {0.110, 0.02, 0.18, 0.9}};

std::vector<RodArc> as_instructed(double less_rad, double rolled_rad) {
  std::vector<RodArc> arcs = kTwoBends;
  arcs.back().angle_rad -= less_rad;
  arcs.back().roll_rad -= rolled_rad;
  return arcs;
}

/// The prior of 1.5° and 3.5° still pulls, by less than this, where the points are exact.
constexpr double kPulled_rad = 0.0035;

TEST(RodStroke, FindsTheBendOnExactPoints) {
  const auto found = measured_bend(as_instructed(0.05, 0.1), kLength_m, kDiameter_m,
                                   stroke(kTwoBends, 0.0, around(0.5)), exact_points());
  ASSERT_TRUE(found.ok()) << found.error().message;
  EXPECT_NEAR(found->arc.angle_rad, 0.18, kPulled_rad);
  EXPECT_NEAR(found->arc.roll_rad, 0.9, 5.0 * kPulled_rad);
  EXPECT_LT(found->rms_m, 1e-4);
  // The rod's place is found too; along its axis only by its two bends.
  EXPECT_LT((found->rod_in_points_m - Vec3{0.3, -0.1, 0.7}).norm(), 0.001);
  EXPECT_DOUBLE_EQ(found->arc.centre_m, 0.110);
}

TEST(RodStroke, DoesNotMindOnWhichSidesTheTipRan) {
  for (const double side_rad : {0.0, 1.0, 2.5, -1.8}) {
    const auto found = measured_bend(as_instructed(0.05, 0.1), kLength_m, kDiameter_m,
                                     stroke(kTwoBends, 0.0, around(side_rad)), exact_points());
    ASSERT_TRUE(found.ok()) << found.error().message;
    EXPECT_NEAR(found->arc.angle_rad, 0.18, kPulled_rad) << side_rad;
  }
}

/// The axis may lie anywhere around a touched line: one pass determines little, and its errors say
/// so.
TEST(RodStroke, OnePassAloneTellsLittle) {
  const auto se_rad = [](const std::vector<double>& sides_rad) {
    return measured_bend(as_instructed(0.05, 0.1), kLength_m, kDiameter_m,
                         stroke(kTwoBends, 0.0, sides_rad))
        ->angle_se_rad;
  };
  EXPECT_GT(se_rad({0.5}), 3.0 * se_rad(around(0.5)));
  EXPECT_LE(se_rad({0.5}), RodStrokeRules{}.angle_sd_rad);
  const auto one_sided = [](const std::vector<double>& sides_rad, double noise_m) {
    return measured_bend(as_instructed(0.05, 0.1), kLength_m, kDiameter_m,
                         stroke(kTwoBends, noise_m, sides_rad))
        ->one_sided;
  };
  for (const double noise_m : {0.0, 0.0005, 0.001}) {
    EXPECT_GT(one_sided({0.5}, noise_m), 0.8);
    EXPECT_LT(one_sided({0.5, 2.6}, noise_m), 0.7) << "a third of a turn apart";
    EXPECT_LT(one_sided(around(0.5), noise_m), 0.3);
  }
}

/// Over many noisy strokes the errors match the standard errors.
TEST(RodStroke, StandardErrorsAreThoseOfTheErrors) {
  double angle_z2 = 0.0;
  double roll_z2 = 0.0;
  constexpr int kStrokes = 40;
  for (int i = 0; i < kStrokes; ++i) {
    Random random(static_cast<std::uint64_t>(i) + 100);
    std::vector<Vec3> points = stroke(kTwoBends, 0.0, around(0.5));
    for (Vec3& p : points) {
      p += {random.normal(0, 0.0015), random.normal(0, 0.0015), random.normal(0, 0.0015)};
    }
    const RodStrokeRules rules;
    const auto start =
        as_instructed(random.normal(0, rules.angle_sd_rad), random.normal(0, rules.roll_sd_rad));
    const auto found = measured_bend(start, kLength_m, kDiameter_m, points, rules);
    ASSERT_TRUE(found.ok()) << found.error().message;
    angle_z2 += std::pow((found->arc.angle_rad - 0.18) / found->angle_se_rad, 2.0) / kStrokes;
    roll_z2 += std::pow((found->arc.roll_rad - 0.9) / found->roll_se_rad, 2.0) / kStrokes;
    EXPECT_LT(found->angle_se_rad, rules.angle_sd_rad);
  }
  // chi-squared of 40 within its central 99.8 %: 0.45 to 1.85. Errors no better than the prior
  // would still pass, so that is checked above.
  EXPECT_GT(angle_z2, 0.45);
  EXPECT_LT(angle_z2, 1.85);
  EXPECT_GT(roll_z2, 0.45);
  EXPECT_LT(roll_z2, 1.85);
}

TEST(RodStroke, CannotFeelTheRollOfTheFirstBend) {
  const std::vector<RodArc> bent = {{0.08, 0.02, 0.25, 0.4}};
  std::vector<RodArc> told = bent;
  told[0].roll_rad = 0.0;
  told[0].angle_rad = 0.22;
  const auto found = measured_bend(told, kLength_m, kDiameter_m, stroke(bent, 0.0, around(0.5)));
  ASSERT_TRUE(found.ok()) << found.error().message;
  EXPECT_NEAR(found->arc.angle_rad, 0.25, kPulled_rad);
  EXPECT_NEAR(found->arc.roll_rad, 0.0, 1e-3);
  EXPECT_NEAR(found->roll_se_rad, RodStrokeRules{}.roll_sd_rad, 1e-3);
}

TEST(LaidRod, LiesWhereTheStrokeRan) {
  const auto found = laid_rod(kLength_m, kDiameter_m, stroke({}, 0.0008, around(0.5)));
  ASSERT_TRUE(found.ok()) << found.error().message;
  // The stroke's ends are known to the noise of one point; across the rod, all points tell.
  const Vec3 along = rotation_from_vector({1.1, -2.0, 0.4}).column(2);
  const Vec3 off_m = found->rod_in_points_m - Vec3{0.3, -0.1, 0.7};
  EXPECT_LT(std::abs(off_m.dot(along)), 0.003);
  EXPECT_LT((off_m - off_m.dot(along) * along).norm(), 0.0005);
  EXPECT_LT((found->points_from_rod.column(2) - along).norm(), 0.01) << "from its first end";
  EXPECT_LT((found->points_from_rod * found->points_from_rod.transposed()).row(0).norm() - 1.0,
            1e-9);
  EXPECT_NEAR(found->length_m, kLength_m, 0.004);
  EXPECT_NEAR(found->rms_m, 0.0008, 0.0002);
}

/// A rod that is not cut yet is longer: it begins where the stroke begins.
TEST(LaidRod, MayBeLongerThanItWillBe) {
  const auto found = laid_rod(0.112, kDiameter_m, stroke({}, 0.0, around(0.5)));
  ASSERT_TRUE(found.ok()) << found.error().message;
  EXPECT_NEAR(found->length_m, kLength_m, 0.001);
  EXPECT_LT((found->rod_in_points_m - Vec3{0.3, -0.1, 0.7}).norm(), 0.001);
}

TEST(LaidRod, RefusesWhatIsNoStrokeOfAStraightRod) {
  const auto refusal = [](double length_m, const std::vector<Vec3>& points) {
    const auto found = laid_rod(length_m, kDiameter_m, points);
    return found.ok() ? std::string() : found.error().message;
  };
  EXPECT_EQ(refusal(kLength_m, std::vector<Vec3>(29)), "stroke of the rod has 29 points, limit 30");
  EXPECT_EQ(refusal(0.2, stroke({}, 0.0, around(0.5))),
            "stroke is 159 mm long, the rod 200 mm: stroke it from end to end");
  EXPECT_THAT(refusal(kLength_m, std::vector<Vec3>(40)), HasSubstr("stroke it from end to end"));
  const std::vector<RodArc> bent = {{0.08, 0.02, 0.44, 0.0}};
  EXPECT_THAT(refusal(0.15, stroke(bent, 0.0, around(0.5))),
              HasSubstr("off the rod (rms), limit 2.0 mm"));
}

TEST(RodStroke, RefusesWhatIsNoStrokeOfThatRod) {
  const auto refusal = [](const std::vector<RodArc>& arcs, const std::vector<Vec3>& points) {
    const auto found = measured_bend(arcs, kLength_m, kDiameter_m, points);
    return found.ok() ? std::string() : found.error().message;
  };
  auto points = stroke(kTwoBends, 0.0, {0.0});
  EXPECT_EQ(refusal({}, points), "stroke of a rod without a bend: there is nothing to measure");
  EXPECT_EQ(refusal(kTwoBends, std::vector<Vec3>(29)), "stroke of the rod has 29 points, limit 30");
  EXPECT_THAT(refusal(kTwoBends, std::vector<Vec3>(40)),
              HasSubstr("stroke is 0 mm long, the rod 15"));
  EXPECT_THAT(refusal(kTwoBends, stroke(kTwoBends, 0.0, around(0.5), 0.0, 0.08)),
              HasSubstr(": stroke it from end to end"));
  points[7].z = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refusal(kTwoBends, points), "point 8 of the stroke is not finite");
  EXPECT_THAT(refusal(kTwoBends, stroke(kTwoBends, 0.008, {0.0, 3.0})),
              HasSubstr("off the rod (rms), limit 3.0 mm"));
}

}  // namespace
}  // namespace orthonav::nav::rod_stroke_test
