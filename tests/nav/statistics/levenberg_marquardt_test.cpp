#include "nav/statistics/levenberg_marquardt.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

namespace orthonav::nav {
namespace {

/// Steps end when the sum gains less than 1e-10 of itself.
constexpr double kAtTheBottom = 1e-6;

TEST(LevenbergMarquardt, FindsTheBottomOfRosenbrocksValley) {
  const std::array<double, 2> start = {-1.2, 1.0};
  const auto fit = levenberg_marquardt(start, [](std::span<const double> p, auto& out) {
    out = {10.0 * (p[1] - p[0] * p[0]), 1.0 - p[0]};
  });
  ASSERT_TRUE(fit.ok());
  EXPECT_NEAR(fit->parameters[0], 1.0, kAtTheBottom);
  EXPECT_NEAR(fit->parameters[1], 1.0, kAtTheBottom);
}

TEST(LevenbergMarquardt, GivesTheCovarianceOfAStraightLine) {
  // y = a + b x at x = -1, 0, 1, 2 with an SD of 0.5: covariance 0.25 (XᵀX)⁻¹ by hand.
  const std::array<double, 2> start = {0.0, 0.0};
  const auto fit = levenberg_marquardt(start, [](std::span<const double> p, auto& out) {
    out.clear();
    for (const double x : {-1.0, 0.0, 1.0, 2.0}) {
      out.push_back((p[0] + p[1] * x - (3.0 - 2.0 * x)) / 0.5);
    }
  });
  ASSERT_TRUE(fit.ok());
  EXPECT_NEAR(fit->parameters[0], 3.0, kAtTheBottom);
  EXPECT_NEAR(fit->parameters[1], -2.0, kAtTheBottom);
  EXPECT_NEAR(fit->covariance[0], 0.25 * 6.0 / 20.0, kAtTheBottom);
  EXPECT_NEAR(fit->covariance[1], 0.25 * -2.0 / 20.0, kAtTheBottom);
  EXPECT_NEAR(fit->covariance[3], 0.25 * 4.0 / 20.0, kAtTheBottom);
}

TEST(LevenbergMarquardt, LeavesWhatNothingTellsWhereItWas) {
  const std::array<double, 2> start = {5.0, 7.0};
  const auto fit =
      levenberg_marquardt(start, [](std::span<const double> p, auto& out) { out = {p[0] - 1.0}; });
  ASSERT_TRUE(fit.ok());
  EXPECT_NEAR(fit->parameters[0], 1.0, kAtTheBottom);
  EXPECT_DOUBLE_EQ(fit->parameters[1], 7.0);
}

TEST(LevenbergMarquardt, RefusesResidualsThatAreNotFinite) {
  const std::array<double, 1> start = {std::numeric_limits<double>::quiet_NaN()};
  const auto fit =
      levenberg_marquardt(start, [](std::span<const double> p, auto& out) { out = {p[0]}; });
  ASSERT_FALSE(fit.ok());
  EXPECT_EQ(fit.error().message, "initial residuals are not finite");
}

}  // namespace
}  // namespace orthonav::nav
