#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "base/random.h"
#include "nav/tracking/pivot.h"

namespace orthonav::nav::pivot_test {
namespace {

using ::testing::HasSubstr;
using Pose = Transform<World, Marker>;

const Vec3 kTip{0.003, -0.15, 0.002};
const Vec3 kPivot{0.4, 1.1, -0.6};

// Turned about the pivot in a cone of the given half angle, with noise of position and rotation.
std::vector<Pose> pivoting(double cone_rad, double twist_rad, double noise_m, Random& random,
                           int count = 200, double turn_rad = 0.37) {
  std::vector<Pose> poses;
  for (int i = 0; i < count; ++i) {
    const double around = turn_rad * i;
    const Mat3 rotation = rotation_from_vector(
        {cone_rad * std::cos(around), twist_rad * std::sin(0.11 * i), cone_rad * std::sin(around)});
    const Vec3 noise{random.normal(0, noise_m), random.normal(0, noise_m),
                     random.normal(0, noise_m)};
    poses.emplace_back(rotation, kPivot - rotation * kTip + noise);
  }
  return poses;
}

/// x of matrix x = right.
Vec3 solved(const Mat3& matrix, Vec3 right) {
  const Vec3 a = matrix.row(0);
  const Vec3 b = matrix.row(1);
  const Vec3 c = matrix.row(2);
  return (right.x * b.cross(c) + right.y * c.cross(a) + right.z * a.cross(b)) /
         matrix.determinant();
}

TEST(PivotCalibration, FindsTipAndPivotExactly) {
  Random random(1);
  const auto found = pivot_calibration(pivoting(0.5, 0.3, 0.0, random));
  ASSERT_TRUE(found.ok()) << found.error().message;
  EXPECT_LT((found->tip_in_marker.v - kTip).norm(), 1e-12);
  EXPECT_LT((found->pivot_in_world.v - kPivot).norm(), 1e-12);
  EXPECT_LT(found->rmse_m, 1e-12);
  EXPECT_GT(found->spread_rad, 0.3);
}

TEST(PivotCalibration, PredictsItsOwnError) {
  double squared = 0.0;
  double predicted = 0.0;
  constexpr int kTrials = 100;
  for (int trial = 0; trial < kTrials; ++trial) {
    Random random(static_cast<std::uint64_t>(trial));
    const auto found = pivot_calibration(pivoting(0.4, 0.2, 0.0005, random));
    ASSERT_TRUE(found.ok()) << found.error().message;
    EXPECT_NEAR(found->rmse_m, 0.0005 * std::sqrt(3.0), 0.0001);
    squared += (found->tip_in_marker.v - kTip).squared_norm();
    predicted += found->tip_sigma_m * found->tip_sigma_m;
  }
  // 100 draws of three numbers: the ratio of variances lies within 25 % (3 SD). The larger of two
  // estimates is told, which is 10 % above the truth in the mean.
  EXPECT_NEAR(squared / predicted, 0.85, 0.25);
}

// Pivoting whose error is partly white, partly that of a tip which wanders in its seat: correlated
// over so many poses.
std::vector<Pose> wandering(double correlated_poses, double white_share, Random& random,
                            int count = 200, double turn_rad = 0.37) {
  constexpr double kNoiseM = 0.0003;
  const double decay = std::exp(-1.0 / correlated_poses);
  const auto draw = [&random](double sd_m) {
    return Vec3{random.normal(0, sd_m), random.normal(0, sd_m), random.normal(0, sd_m)};
  };
  const double wander_m = kNoiseM * std::sqrt(1.0 - white_share);
  Vec3 seat_m = draw(wander_m);
  auto poses = pivoting(0.4, 0.2, kNoiseM * std::sqrt(white_share), random, count, turn_rad);
  for (Pose& pose : poses) {
    pose = {pose.rotation(), pose.translation() + seat_m};
    seat_m = decay * seat_m + draw(wander_m * std::sqrt(1.0 - decay * decay));
  }
  return poses;
}

// In percent of many pivots: how often the true tip is in the ellipsoid that holds 68 or 95 % of a
// normal distribution.
struct Coverage {
  double of_68 = 0.0;
  double of_95 = 0.0;
};

Coverage coverage(double correlated_poses, double white_share, int count, double turn_rad) {
  constexpr int kTrials = 300;
  // Of chi-square with three degrees of freedom.
  constexpr double kQuantile68 = 3.506;
  constexpr double kQuantile95 = 7.815;
  Coverage percent;
  for (int trial = 0; trial < kTrials; ++trial) {
    Random random(static_cast<std::uint64_t>(1000 + trial));
    const auto poses = wandering(correlated_poses, white_share, random, count, turn_rad);
    std::vector<std::size_t> all(poses.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    const auto fit = fit_pivot(poses, all);
    const Mat3 covariance = tip_uncertainty(poses, all, *fit).covariance_m2;
    const Vec3 off_m = fit->tip_in_marker.v - kTip;
    const double squared = off_m.dot(solved(covariance, off_m));
    percent.of_68 += (squared <= kQuantile68 ? 100.0 : 0.0) / kTrials;
    percent.of_95 += (squared <= kQuantile95 ? 100.0 : 0.0) / kTrials;
  }
  return percent;
}

TEST(TipUncertainty, CoversTheTruthWithAndWithoutCorrelation) {
  // 300 draws: 2.7 % and 1.3 % SD; three of them, and the estimate of a correlation from so few.
  constexpr double kWorst68 = 9.0;
  constexpr double kWorst95 = 5.0;
  struct Case {
    double correlated_poses;
    double white_share;
    int count = 200;
    double turn_rad = 0.37;
  };
  for (const Case& c : {Case{1, 1}, Case{3, 0.3}, Case{8, 0}, Case{8, 0.3}, Case{20, 0.3},
                        Case{20, 0.3, 200, 0.1}, Case{12, 0.0, 480, 0.06}}) {
    const Coverage percent = coverage(c.correlated_poses, c.white_share, c.count, c.turn_rad);
    EXPECT_NEAR(percent.of_68, 68.0, kWorst68) << c.correlated_poses << ' ' << c.turn_rad;
    EXPECT_NEAR(percent.of_95, 95.0, kWorst95) << c.correlated_poses << ' ' << c.turn_rad;
  }
  // A single turn, whose errors are correlated over an eighth of it, tells its own error less well.
  EXPECT_GT(coverage(10.0, 0.05, 80, 0.08).of_95, 80.0);
}

TEST(TipUncertainty, TellsHowManyPosesAreIndependent) {
  const auto independent = [](double correlated_poses, double white_share) {
    Random random(12);
    const auto found = pivot_calibration(wandering(correlated_poses, white_share, random));
    return found.ok() ? found->independent_poses : 0.0;
  };
  EXPECT_EQ(independent(1.0, 1.0), 200.0);
  // 200 (1 - d) / (1 + d) with d = exp(-1/8), to the factor that 200 poses can tell.
  EXPECT_NEAR(independent(8.0, 0.0), 12.5, 7.0);
}

TEST(PivotCalibration, RefusesTooLittleTurning) {
  Random random(2);
  EXPECT_THAT(pivot_calibration(pivoting(0.1, 0.0, 0.0, random)).error().message,
              HasSubstr("turned by"));
  // Twisting about one axis leaves the tip free along it, however far it turns.
  EXPECT_FALSE(pivot_calibration(pivoting(0.0, 1.5, 0.0, random)).ok());
  EXPECT_TRUE(pivot_calibration(pivoting(0.25, 0.0, 0.0, random)).ok());
}

// Moves the tip at some of the poses, as when it is lifted off or the tag is seen wrongly.
void disturb(std::vector<Pose>& poses, std::size_t from, std::size_t to, Vec3 translation_m) {
  for (std::size_t i = from; i < to; ++i) {
    poses[i] = {poses[i].rotation(), poses[i].translation() + translation_m};
  }
}

TEST(PivotCalibration, RefusesATipThatSlipped) {
  for (const double slip_m : {0.006, 0.02}) {
    Random random(3);
    auto poses = pivoting(0.4, 0.2, 0.0002, random);
    disturb(poses, poses.size() / 2, poses.size(), {slip_m, 0, 0});
    EXPECT_THAT(pivot_calibration(poses).error().message, HasSubstr("slip")) << slip_m;
  }
}

TEST(PivotCalibration, LeavesOutWhatIsNoPivoting) {
  Random random(5);
  auto poses = pivoting(0.4, 0.2, 0.0002, random);
  // The pointer is brought, and taken away again; in between single poses are far off.
  for (std::size_t i = 0; i < 20; ++i) {
    const double far_m = 0.01 * static_cast<double>(21 - i);
    disturb(poses, i, i + 1, {far_m, far_m, 0});
    disturb(poses, 199 - i, 200 - i, {0, far_m, far_m});
  }
  for (std::size_t i = 30; i < 170; i += 10) {
    poses[i] = {rotation_from_vector({0, 0, 0.5}) * poses[i].rotation(), poses[i].translation()};
  }
  const auto found = pivot_calibration(poses);
  ASSERT_TRUE(found.ok()) << found.error().message;
  EXPECT_LT((found->tip_in_marker.v - kTip).norm(), 4.0 * found->tip_sigma_m);
  EXPECT_LT(found->tip_sigma_m, 0.0001);
  EXPECT_EQ(found->inliers, 146u);
  for (std::size_t i = 0; i < 200; ++i) {
    EXPECT_EQ(found->inlier[i], i >= 20 && i < 180 && (i < 30 || i >= 170 || i % 10 != 0)) << i;
  }
  EXPECT_EQ(found->judgement.verdict, Verdict::kNote);
  EXPECT_THAT(found->judgement.reason, HasSubstr("73 % of the poses agree, better 90 %"));
}

TEST(PivotCalibration, IsTheCleanOneDespiteOutliers) {
  constexpr double kSameM = 0.00005;
  Random random(11);
  auto poses = wandering(8.0, 0.3, random);
  std::vector<Pose> clean;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (i % 10 >= 3) {
      clean.push_back(poses[i]);
      continue;
    }
    disturb(poses, i, i + 1,
            {random.normal(0, 0.02), random.normal(0, 0.02), random.normal(0, 0.02)});
  }
  const auto undisturbed = pivot_calibration(clean);
  ASSERT_TRUE(undisturbed.ok()) << undisturbed.error().message;
  const auto spoilt = pivot_calibration(poses);
  ASSERT_TRUE(spoilt.ok()) << spoilt.error().message;
  EXPECT_LT((spoilt->tip_in_marker - undisturbed->tip_in_marker).norm(), kSameM);
}

TEST(PivotCalibration, RefusesWhenTooFewPosesAgree) {
  Random random(6);
  auto poses = pivoting(0.4, 0.2, 0.0002, random);
  for (std::size_t i = 0; i < 90; ++i) {  // 45 % everywhere
    disturb(poses, i, i + 1, {random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1), 0.05});
  }
  EXPECT_THAT(pivot_calibration(poses).error().message,
              HasSubstr("55 % of the poses agree on a pivot, at least 60 %"));
  PivotOptions lenient;
  lenient.min_inlier_fraction = 0.5;
  EXPECT_TRUE(pivot_calibration(poses, lenient).ok());
}

TEST(PivotCalibration, SeesADriftThatTheResidualHides) {
  // The pivot creeps by 2 mm while the tool leans over once, from one side to the other.
  const auto leaning = [](double creep_m) {
    Random random(7);
    std::vector<Pose> poses;
    for (int i = 0; i < 200; ++i) {
      const double done = i / 199.0;
      const Mat3 rotation = rotation_from_vector(
          {0.8 * done - 0.4, 0.2 * std::sin(0.7 * i), 0.3 * std::sin(0.9 * i)});
      const Vec3 noise{random.normal(0, 1e-4), random.normal(0, 1e-4), random.normal(0, 1e-4)};
      poses.emplace_back(rotation,
                         kPivot + Vec3{0, 0, creep_m * done * done} - rotation * kTip + noise);
    }
    return pivot_calibration(poses);
  };
  const auto steady = leaning(0.0);
  const auto creeping = leaning(0.002);
  ASSERT_TRUE(steady.ok() && creeping.ok());
  EXPECT_LT(steady->leave_out_m, 0.0001);
  EXPECT_GT(creeping->leave_out_m, 5.0 * steady->leave_out_m);
  EXPECT_GE(creeping->tip_sigma_m, creeping->leave_out_m);
  EXPECT_EQ(steady->judgement.verdict, Verdict::kPass) << steady->judgement.reason;
  EXPECT_EQ(creeping->judgement.verdict, Verdict::kNote) << creeping->judgement.reason;
}

TEST(PivotCalibration, GivesTheSameBitsAgain) {
  Random random(8);
  const auto poses = pivoting(0.4, 0.2, 0.001, random);
  const auto first = pivot_calibration(poses);
  const auto second = pivot_calibration(poses);
  ASSERT_TRUE(first.ok() && second.ok());
  EXPECT_EQ(first->tip_in_marker, second->tip_in_marker);
  EXPECT_EQ(first->inlier, second->inlier);
}

TEST(PivotCalibration, ChecksItsOptions) {
  EXPECT_THAT(PivotOptions{}.check(), ::testing::IsEmpty());
  PivotOptions bad;
  bad.min_poses = 2;
  bad.min_spread_rad = 0.0;
  bad.max_rmse_m = -1.0;
  bad.inlier_m = std::numeric_limits<double>::quiet_NaN();
  bad.max_tip_sigma_m = std::numeric_limits<double>::infinity();
  bad.min_inlier_fraction = 1.1;
  bad.rounds = 0;
  EXPECT_THAT(bad.check(), ::testing::SizeIs(7));
  Random random(9);
  const auto refused = pivot_calibration(pivoting(0.4, 0.2, 0.0, random), bad);
  ASSERT_FALSE(refused.ok());
  EXPECT_THAT(refused.error().message, HasSubstr("min_poses 2, must be at least 3; "));
}

TEST(PivotCalibration, RefusesTooFewAndNonFinitePoses) {
  Random random(4);
  EXPECT_THAT(pivot_calibration(pivoting(0.4, 0.2, 0.0, random, 19)).error().message,
              HasSubstr("19 poses, at least 20"));
  EXPECT_FALSE(pivot_calibration({}).ok());
  auto poses = pivoting(0.4, 0.2, 0.0, random);
  poses[5] = {poses[5].rotation(), {std::numeric_limits<double>::quiet_NaN(), 0, 0}};
  EXPECT_THAT(pivot_calibration(poses).error().message, HasSubstr("not finite"));
}

TEST(PivotCalibration, RefusesATipThatIsNotKnown) {
  Random random(10);
  PivotOptions strict;
  strict.max_tip_sigma_m = 0.00002;
  EXPECT_THAT(pivot_calibration(pivoting(0.25, 0.1, 0.0005, random), strict).error().message,
              HasSubstr("the tip is known to"));
}

}  // namespace
}  // namespace orthonav::nav::pivot_test
