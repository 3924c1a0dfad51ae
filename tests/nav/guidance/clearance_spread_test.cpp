#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <Eigen/Cholesky>
#include <numbers>
#include <vector>

#include "base/random.h"
#include "nav/guidance/screw_clearance.h"
#include "tests/support/allocation_count.h"
#include "tests/support/anatomy.h"
#include "tests/support/mesh_builder.h"

namespace orthonav::nav::clearance_spread_test {
namespace {

/// The 95 % quantile of the standard normal distribution.
constexpr double kQuantile95 = 1.6448536;
/// The error of the quantile from 1024 motions, in SDs.
constexpr double kMotions = 0.05;

PoseUncertainty with_sds(Vec3 centre_m, double translation_m, double rotation_rad) {
  std::array<double, 36> covariance{};
  for (std::size_t k = 0; k < 3; ++k) {
    covariance[7 * k] = translation_m * translation_m;
    covariance[7 * (k + 3)] = rotation_rad * rotation_rad;
  }
  return {centre_m, covariance};
}

/// All walls are at least 100 mm away except one at x = 10 mm.
const SurfaceIndex& one_wall() {
  static const SurfaceIndex kBox(test::box({-0.100, -0.200, -0.100}, {0.010, 0.100, 0.100}));
  return kBox;
}
const SurfaceIndex& two_walls() {
  static const SurfaceIndex kBox(test::box({-0.010, -0.200, -0.100}, {0.010, 0.100, 0.100}));
  return kBox;
}

const ScrewCylinder kScrew{{{0.0, 0.020, 0.0}}, {0, -1, 0}, 0.045, 0.003};
const Vec3 kMiddle{0.0, -0.0055, 0.0};

/// Of a model that is exact, unless another is given.
ClearanceSpread spread_of(const SurfaceIndex& bone, const ScrewCylinder& screw,
                          const PoseUncertainty& pose, const ModelError& model = {0.0}) {
  return *screw_clearance(bone, screw, &pose, model)->spread;
}

TEST(ClearanceSpread, OfAShiftBesideOneWallIsTheNormalQuantile) {
  for (const double sd_m : {0.0003, 0.001, 0.002}) {
    const auto spread = spread_of(one_wall(), kScrew, with_sds(kMiddle, sd_m, 0.0));
    EXPECT_NEAR(spread.lower_95_m, 0.007 - kQuantile95 * sd_m, kMotions * sd_m);
  }
}

TEST(ClearanceSpread, WithoutUncertaintyIsTheClearance) {
  const auto spread = spread_of(one_wall(), kScrew, with_sds(kMiddle, 0.0, 0.0));
  EXPECT_NEAR(spread.lower_95_m, 0.007, 1e-6);
  EXPECT_EQ(spread.probability(PedicleGrade::kA), 1.0);
}

TEST(ClearanceSpread, BetweenTwoWallsIsLessThanBesideOne) {
  const double sd_m = 0.001;
  const auto spread = spread_of(two_walls(), kScrew, with_sds(kMiddle, sd_m, 0.0));
  // The larger of a normal number and its negative: 1.96, not 1.64.
  EXPECT_NEAR(spread.lower_95_m, 0.007 - 1.959964 * sd_m, kMotions * sd_m);
}

TEST(ClearanceSpread, OfATurnGrowsWithTheDistanceFromTheCentre) {
  const double sd_rad = 0.02;
  const Vec3 tip = kScrew.entry.v + kScrew.length_m * kScrew.direction;
  const auto about_tip = spread_of(one_wall(), kScrew, with_sds(tip, 0.0, sd_rad));
  // The far end of the side is 39 mm from the tip; the rim lies 3 mm aside.
  const double lever_arm_m = 0.039;
  EXPECT_NEAR(about_tip.lower_95_m, 0.007 - kQuantile95 * sd_rad * lever_arm_m, 0.0001);
  const auto from_afar =
      spread_of(one_wall(), kScrew, with_sds(tip + Vec3{0, -0.05, 0}, 0.0, sd_rad));
  EXPECT_NEAR(from_afar.lower_95_m, 0.007 - kQuantile95 * sd_rad * (lever_arm_m + 0.05), 0.0002);
}

TEST(ClearanceSpread, GradesAreAsLikelyAsTheNormalDistributionSays) {
  ScrewCylinder screw = kScrew;
  screw.entry.v.x = 0.0085;  // 1.5 mm out
  const double sd_m = 0.001;
  const auto spread = spread_of(one_wall(), screw, with_sds(kMiddle, sd_m, 0.0));
  const auto below = [](double sds) { return 0.5 * std::erfc(-sds / std::sqrt(2.0)); };
  constexpr double kFraction = 0.006;  // of 1024 motions
  EXPECT_NEAR(spread.probability(PedicleGrade::kA), below(-1.5), kFraction);
  EXPECT_NEAR(spread.probability(PedicleGrade::kB), below(0.5) - below(-1.5), kFraction);
  EXPECT_NEAR(spread.probability(PedicleGrade::kC), below(2.5) - below(0.5), kFraction);
  EXPECT_NEAR(spread.probability(PedicleGrade::kD), below(4.5) - below(2.5), kFraction);
  double sum = 0.0;
  for (const double p : spread.grade_probability) {
    sum += p;
  }
  EXPECT_NEAR(sum, 1.0, 1e-12);
}

/// The 5 % quantile of the least depth beside one wall whose places are off by the model's error,
/// drawn from its covariance between 400 places of the screw.
double least_beside_a_wall_m(const ModelError& model) {
  constexpr int kAlong = 40;
  constexpr int kAround = 10;
  constexpr int kDraws = 4000;
  std::vector<Vec3> walls;
  std::vector<double> depths_m;
  for (int i = 0; i < kAlong; ++i) {
    for (int k = 0; k < kAround; ++k) {
      const double around_rad = std::numbers::pi / 3.0 * (2.0 * k / (kAround - 1) - 1.0);
      const double y_m = 0.014 - 0.039 * i / (kAlong - 1);
      walls.push_back({0.010, y_m, kScrew.radius_m * std::sin(around_rad)});
      depths_m.push_back(0.010 - kScrew.radius_m * std::cos(around_rad));
    }
  }
  const auto n = static_cast<Eigen::Index>(walls.size());
  Eigen::MatrixXd covariance(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      covariance(i, j) = shared_error_m2(model, walls[static_cast<std::size_t>(i)],
                                         walls[static_cast<std::size_t>(j)]);
    }
  }
  const Eigen::MatrixXd root = covariance.llt().matrixL();
  Random random(3);
  std::vector<double> least_m;
  for (int draw = 0; draw < kDraws; ++draw) {
    Eigen::VectorXd normal(n);
    for (double& v : normal) {
      v = random.normal();
    }
    const Eigen::VectorXd off_m = root * normal;
    double least = 1e9;
    for (Eigen::Index i = 0; i < n; ++i) {
      least = std::min(least, depths_m[static_cast<std::size_t>(i)] + off_m(i));
    }
    least_m.push_back(least);
  }
  std::nth_element(least_m.begin(), least_m.begin() + kDraws / 20, least_m.end());
  return least_m[kDraws / 20];
}

TEST(ClearanceSpread, HoldsHowFarTheWallsMayBeOffTheirModel) {
  for (const double length_m : {0.005, 0.010}) {
    const ModelError model{0.0005, length_m};
    const auto spread = spread_of(one_wall(), kScrew, with_sds(kMiddle, 0.0, 0.0), model);
    const double expected_m = least_beside_a_wall_m(model);
    EXPECT_NEAR(spread.lower_95_m, expected_m, 0.3 * model.sd_m);
    // More than one place of the wall would take, less than places that share nothing.
    EXPECT_LT(expected_m, 0.007 - kQuantile95 * model.sd_m);
    EXPECT_GT(expected_m, 0.007 - 3.5 * model.sd_m);
  }
  const PoseUncertainty exact = with_sds(kMiddle, 0.0, 0.0);
  EXPECT_EQ(screw_clearance(one_wall(), kScrew, &exact)->spread->lower_95_m,
            spread_of(one_wall(), kScrew, exact, {kUsualModelError_m}).lower_95_m)
      << "the usual error, unless another is told";
}

TEST(ClearanceSpread, IsAbsentWhereTheCovarianceIsNoNumber) {
  const auto unknown = with_sds(kMiddle, INFINITY, 0.0);
  const auto nowhere = with_sds({NAN, 0, 0}, 0.001, 0.0);
  for (const PoseUncertainty* pose : {&unknown, &nowhere}) {
    const auto found = screw_clearance(one_wall(), kScrew, pose);
    EXPECT_NEAR(found->least.clearance_m, 0.007, 1e-6);
    EXPECT_FALSE(found->spread.has_value());
  }
}

TEST(ClearanceSpread, AllocatesNothing) {
  const PoseUncertainty pose = with_sds(kMiddle, 0.001, 0.01);
  (void)screw_clearance(one_wall(), kScrew, &pose);
  const std::size_t before = test::allocation_count();
  const auto found = screw_clearance(one_wall(), kScrew, &pose);
  EXPECT_EQ(test::allocation_count() - before, 0u);
  EXPECT_TRUE(found && found->spread);
}

/// How often the truth lies above the bound: screws of real plans are moved by random motions from
/// the bound's covariance, enlarged by the factor `more`.
struct Honesty {
  int draws = 0;
  int above = 0;
  int grade_as_expected = 0;  ///< the truth has the likeliest grade
  double expected = 0.0;      ///< the sum of that grade's probabilities
  [[nodiscard]] double fraction() const { return static_cast<double>(above) / draws; }
};

Honesty honesty(double more) {
  constexpr int kDraws = 60;
  Honesty out;
  Random random(11);
  for (const test::AnatomyLevel& level : test::sampled_anatomy_levels()) {
    const SurfaceIndex bone(level.mesh);
    for (const ScrewPlan& plan : level.screws) {
      const auto screw = *cylinder_of(plan);
      const double translation_m = random.uniform(0.0003, 0.0015);
      const double rotation_rad = random.uniform(0.003, 0.03);
      const Vec3 centre = 0.5 * (plan.entry.v + plan.target.v) + Vec3{0, 0.02, 0};
      const auto spread = spread_of(bone, screw, with_sds(centre, translation_m, rotation_rad));
      const auto likeliest = static_cast<PedicleGrade>(
          std::max_element(spread.grade_probability.begin(), spread.grade_probability.end()) -
          spread.grade_probability.begin());
      for (int k = 0; k < kDraws; ++k) {
        const Vec3 translation =
            more * translation_m * Vec3{random.normal(), random.normal(), random.normal()};
        const Vec3 rotation_vector =
            more * rotation_rad * Vec3{random.normal(), random.normal(), random.normal()};
        const Mat3 rotation = rotation_from_vector(rotation_vector);
        ScrewCylinder real = screw;
        real.entry.v = centre + rotation * (screw.entry.v - centre) + translation;
        real.direction = rotation * screw.direction;
        const double clearance_m = least_clearance(bone, real)->clearance_m;
        ++out.draws;
        out.above += clearance_m > spread.lower_95_m ? 1 : 0;
        out.grade_as_expected += grade_of(clearance_m) == likeliest ? 1 : 0;
        out.expected += spread.probability(likeliest);
      }
    }
  }
  return out;
}

TEST(ClearanceSpread, BoundHoldsIn95Of100DrawsOnRealVertebrae) {
  const Honesty honest = honesty(1.0);
  RecordProperty("draws", honest.draws);
  RecordProperty("share", std::to_string(honest.fraction()));
  ASSERT_GE(honest.draws, 400);
  EXPECT_GE(honest.fraction(), 0.93);
  EXPECT_LE(honest.fraction(), 0.97);
  EXPECT_NEAR(honest.grade_as_expected / static_cast<double>(honest.draws),
              honest.expected / honest.draws, 0.03);
  // The counterparts: a covariance that is too small, or too large.
  EXPECT_LT(honesty(1.3).fraction(), 0.93);
  EXPECT_GT(honesty(0.7).fraction(), 0.97);
}

}  // namespace
}  // namespace orthonav::nav::clearance_spread_test
