#include "study/mean_interval.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace orthonav::engine {
namespace {

/// The truncation error of the series of Abramowitz & Stegun, largest at three degrees of freedom.
constexpr double kSeriesError = 0.03;

TEST(MeanInterval, KnowsTheTableOfStudentsT) {
  EXPECT_NEAR(student_t_975(2.0), 4.3027, 1e-4);
  EXPECT_NEAR(student_t_975(3.0), 3.1824, kSeriesError);
  EXPECT_NEAR(student_t_975(4.0), 2.7764, kSeriesError);
  EXPECT_NEAR(student_t_975(10.0), 2.2281, 1e-3);
  EXPECT_NEAR(student_t_975(99.0), 1.9842, 1e-4);
}

TEST(MeanInterval, IsAsWideAsItsValuesScatter) {
  const std::vector<double> values = {1.0, 2.0, 3.0};
  const MeanInterval found = mean_interval(values);
  EXPECT_DOUBLE_EQ(found.mean, 2.0);
  // t of two degrees of freedom, SD 1, three values.
  EXPECT_NEAR(found.high - found.mean, 4.3027 / std::sqrt(3.0), 1e-4);
  EXPECT_DOUBLE_EQ(found.mean - found.low, found.high - found.mean);
}

TEST(MeanInterval, SaysNothingOfFewerThanThreeValues) {
  const std::vector<double> two = {1.0, 2.0};
  EXPECT_DOUBLE_EQ(mean_interval(two).mean, 1.5);
  EXPECT_TRUE(std::isnan(mean_interval(two).low));
  EXPECT_TRUE(std::isnan(mean_interval(two).high));
  EXPECT_TRUE(std::isnan(mean_interval({}).low));
}

}  // namespace
}  // namespace orthonav::engine
