#include "study/two_samples.h"

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

}  // namespace
}  // namespace orthonav::engine::two_samples_test
