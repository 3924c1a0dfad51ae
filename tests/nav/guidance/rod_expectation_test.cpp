#include "nav/guidance/rod_expectation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace orthonav::nav {
namespace {

RodFit fit_of(const std::vector<double>& off_m) {
  RodFit fit;
  for (const double off : off_m) {
    fit.seats.push_back({0.0, off});
  }
  return fit;
}

/// Four seats leave half of the variance: Rayleigh's distribution with 0.25 mm² / 2.
TEST(RodExpectation, IsThatOfTheDistancesAcrossTheRod) {
  const RodExpectationRules rules{.limit_m = 0.001, .bending_sd_m = 0.0003};
  const std::vector<double> sd_m(4, 0.0004);
  const auto found = rod_expectation(fit_of({0, 0, 0, 0}), sd_m, rules);
  EXPECT_NEAR(found.within, std::pow(1.0 - std::exp(-0.5 / 0.125), 4.0), 1e-12);
}

TEST(RodExpectation, NamesTheSeatThatIsMostLikelyBeyond) {
  EXPECT_EQ(
      rod_expectation(fit_of({0, 0, 0, 0}), std::vector{0.2e-3, 0.2e-3, 0.5e-3, 0.3e-3}).least_sure,
      2U);
  EXPECT_EQ(rod_expectation(fit_of({0, 0.4e-3, 0, 0}), std::vector(4, 0.3e-3)).least_sure, 1U);
}

TEST(RodExpectation, FallsWithUncertaintyAndWithPlannedDistance) {
  const auto within = [](double sd_m, double off_m) {
    return rod_expectation(fit_of({0, off_m, 0, 0, 0}), std::vector(5, sd_m)).within;
  };
  EXPECT_GT(within(0.2e-3, 0.0), 0.98);
  EXPECT_LT(within(0.35e-3, 0.0), 0.95);
  EXPECT_LT(within(0.2e-3, 0.5e-3), within(0.2e-3, 0.2e-3));
  EXPECT_EQ(within(0.2e-3, 1.1e-3), 0.0) << "planned beyond the limit";
}

/// Two seats are joined by a straight rod wherever they were touched.
TEST(RodExpectation, OfTwoSeatsIsCertain) {
  EXPECT_EQ(rod_expectation(fit_of({0, 0}), std::vector(2, 1e-3)).within, 1.0);
}

}  // namespace
}  // namespace orthonav::nav
