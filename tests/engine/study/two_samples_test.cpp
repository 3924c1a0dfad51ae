#include "engine/study/two_samples.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"

namespace orthonav::engine::two_samples_test {
namespace {

TEST(StudentP, IsThatOfTheTables) {
  EXPECT_NEAR(student_p(2.228, 10.0), 0.05, 2e-5);
  EXPECT_NEAR(student_p(-2.228, 10.0), 0.05, 2e-5);
  EXPECT_NEAR(student_p(12.706, 1.0), 0.05, 2e-5);
  EXPECT_NEAR(student_p(2.576, 1e6), 0.01, 2e-5);
  EXPECT_NEAR(student_p(0.0, 5.0), 1.0, 1e-12);
}

TEST(WelchP, WeighsBothErrorsAndTheirDegreesOfFreedom) {
  // Two samples of ten with the same SD: the t test of 18 degrees of freedom.
  EXPECT_NEAR(welch_p({2.101 * std::sqrt(2.0), 1.0, 9.0}, {0.0, 1.0, 9.0}), 0.05, 1e-4);
  // An exact sample leaves the other's standard error.
  EXPECT_NEAR(welch_p({2.262, 1.0, 9.0}, {0.0, 0.0, 1e9}), 0.05, 1e-4);
  EXPECT_EQ(welch_p({1.0, 0.0, 9.0}, {1.0, 0.0, 9.0}), 1.0);
  EXPECT_EQ(welch_p({1.0, 0.0, 9.0}, {2.0, 0.0, 9.0}), 0.0);
}

TEST(EquivalenceP, IsSmallOnlyWhereAllIsWellWithinTheMargin) {
  const std::vector<double> near = {0.1, -0.1, 0.05, -0.05, 0.0, 0.08, -0.08, 0.02};
  EXPECT_LT(equivalence_p(near, 0.2), 0.001);
  EXPECT_GT(equivalence_p(near, 0.02), 0.05);
  const std::vector<double> off = {0.3, 0.1, 0.25, 0.15, 0.2, 0.28, 0.12, 0.22};
  EXPECT_GT(equivalence_p(off, 0.2), 0.5) << "a mean at the margin";
  EXPECT_LT(equivalence_p(off, 0.4), 0.001);
  // t = 2.015 of 5 degrees of freedom is 5 % on one side.
  const std::vector<double> six = {-1, 1, -1, 1, -1, 1};
  const double error = std::sqrt(6.0 / 5.0) / std::sqrt(6.0);
  EXPECT_NEAR(equivalence_p(six, 2.015 * error), 0.05, 1e-4);
  EXPECT_EQ(equivalence_p(std::vector<double>{0.0, 0.0}, 1.0), 1.0);
}

std::vector<std::vector<double>> operations(double sd) {
  Random random(3);
  std::vector<std::vector<double>> groups(200);
  for (auto& group : groups) {
    for (int screw = 0; screw < 4; ++screw) {
      group.push_back(std::hypot(random.normal(0.0, sd), random.normal(0.0, sd)));
    }
  }
  return groups;
}

TEST(ResampledSdP, KeepsWhatCouldComeOfThemAndRejectsWhatCouldNot) {
  const auto groups = operations(1.0);  // Rayleigh: an SD of 0.655
  EXPECT_GT(resampled_sd_p(groups, 20, 0.655), 0.5);
  EXPECT_GT(resampled_sd_p(groups, 20, 0.50), 0.05);
  EXPECT_LT(resampled_sd_p(groups, 20, 0.30), 0.05);
  EXPECT_LT(resampled_sd_p(groups, 20, 1.10), 0.05);
  EXPECT_LT(resampled_sd_p(groups, 200, 0.50), 0.05) << "more values tell more";
}

}  // namespace
}  // namespace orthonav::engine::two_samples_test
