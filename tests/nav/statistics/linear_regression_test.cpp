#include "nav/statistics/linear_regression.h"

#include <gmock/gmock.h>

#include <cmath>
#include <vector>

#include "base/random.h"

namespace orthonav::nav {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

struct Sample {
  std::vector<double> x;
  std::vector<double> y;
};

/// y = 2 - 3·u + noise, with rows (1, u) and u in [0, 1); the noise's SD is `scatter`·|u - 0.5|.
Sample line(int n, double scatter, std::uint64_t seed) {
  Random random(seed);
  Sample out;
  for (int i = 0; i < n; ++i) {
    const double u = random.uniform();
    out.x.insert(out.x.end(), {1.0, u});
    out.y.push_back(2.0 - 3.0 * u + random.normal(0.0, scatter * std::abs(u - 0.5)));
  }
  return out;
}

TEST(LinearRegression, FindsALineExactly) {
  const Sample exact = line(20, 0.0, 1);
  const LinearRegression found = linear_regression(exact.x, exact.y);
  ASSERT_THAT(found.slopes, SizeIs(2));
  EXPECT_NEAR(found.slopes[0], 2.0, 1e-12);
  EXPECT_NEAR(found.slopes[1], -3.0, 1e-12);
  EXPECT_NEAR(found.standard_errors[1], 0.0, 1e-12);
}

TEST(LinearRegression, StandardErrorsHoldWhereScatterIsLargerAtTheEnds) {
  double squared = 0.0;
  double predicted = 0.0;
  constexpr int kRepeats = 400;
  for (int i = 0; i < kRepeats; ++i) {
    const Sample sample = line(200, 1.0, 100 + static_cast<std::uint64_t>(i));
    const LinearRegression found = linear_regression(sample.x, sample.y);
    squared += (found.slopes[1] + 3.0) * (found.slopes[1] + 3.0) / kRepeats;
    predicted += found.standard_errors[1] * found.standard_errors[1] / kRepeats;
  }
  // 400 repeats know an SD to 3.5 %. If the scatter were taken to be the same everywhere, the ratio
  // would be the root of (1/12)² / (1/80), 0.75.
  EXPECT_NEAR(std::sqrt(predicted / squared), 1.0, 0.12);
}

TEST(LinearRegression, FindsNothingWhereColumnsOrRowsDoNotSuffice) {
  const std::vector<double> twice = {1, 2, 1, 2, 1, 2, 1, 2};
  EXPECT_THAT(linear_regression(twice, std::vector<double>{1, 2, 3, 4}).slopes, IsEmpty());
  const std::vector<double> two_rows = {1, 0, 1, 1};
  EXPECT_THAT(linear_regression(two_rows, std::vector<double>{1, 2}).slopes, IsEmpty());
  EXPECT_THAT(linear_regression({}, {}).slopes, IsEmpty());
}

}  // namespace
}  // namespace orthonav::nav
