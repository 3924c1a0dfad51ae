#include "nav/registration/tissue_prior.h"

#include <gtest/gtest.h>

namespace orthonav::nav {
namespace {

constexpr FieldHypothesis kBare{};
constexpr FieldHypothesis kField{.sd_m = 0.0006, .length_m = 0.02};
constexpr FieldHypothesis kSmallField{.sd_m = 0.00015, .length_m = 0.02};

TEST(TissuePrior, ALightHandChangesNothing) {
  for (const FieldHypothesis& field : {kBare, kField, kSmallField}) {
    for (const double standoff_m : {0.0, 0.0005, 0.0015}) {
      EXPECT_EQ(log_prior_of_evenness(field, standoff_m), 0.0);
    }
  }
}

TEST(TissuePrior, ThickTissueIsNeverEven) {
  EXPECT_EQ(log_prior_of_evenness({.stroke_sd_m = 0.0015}, 0.003), 0.0)
      << "varies by half its mean";
  const double some = log_prior_of_evenness(kField, 0.003);
  const double little = log_prior_of_evenness(kSmallField, 0.003);
  const double even = log_prior_of_evenness(kBare, 0.003);
  EXPECT_LT(some, 0.0);
  EXPECT_LT(little, some);
  EXPECT_LT(even, little);
  EXPECT_GT(even, -6.0) << "unlikely, not excluded";
  EXPECT_LT(even, log_prior_of_evenness(kBare, 0.002)) << "the thicker the less likely";
}

}  // namespace
}  // namespace orthonav::nav
