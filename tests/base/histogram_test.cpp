#include "base/histogram.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/random.h"

namespace orthonav {
namespace {

constexpr double kWithin = 0.005 * 1.01;  ///< half of a bin, and what it is rounded by

TEST(Histogram, FindsQuantilesWithinHalfOfABin) {
  Random random(3);
  Histogram histogram;
  std::vector<double> values;
  for (int i = 0; i < 20'000; ++i) {
    values.push_back(std::exp(3.0 * random.normal()));
    histogram.add(values.back());
  }
  std::sort(values.begin(), values.end());
  for (const double fraction : {0.01, 0.5, 0.95, 0.99, 0.999}) {
    const auto rank = static_cast<std::size_t>(std::ceil(fraction * 20'000.0));
    EXPECT_NEAR(histogram.quantile(fraction).value(), values[rank - 1], kWithin * values[rank - 1])
        << fraction;
  }
  EXPECT_EQ(histogram.quantile(0.0), values.front());
  EXPECT_EQ(histogram.quantile(1.0), values.back());
  EXPECT_EQ(histogram.count(), 20'000);
}

TEST(Histogram, IsExactForEqualValues) {
  Histogram histogram;
  for (int i = 0; i < 1000; ++i) {
    histogram.add(33.333);
  }
  EXPECT_EQ(histogram.quantile(0.5), 33.333);
  EXPECT_NEAR(histogram.mean().value(), 33.333, 1e-9);
}

TEST(Histogram, TakesWhatLiesBeyondItsBins) {
  Histogram histogram;
  EXPECT_FALSE(histogram.quantile(0.5).has_value());
  EXPECT_FALSE(histogram.mean().has_value());
  for (const double value : {-2.0, 0.0, 1e-9, 5.0, 1e12}) {
    histogram.add(value);
  }
  EXPECT_EQ(histogram.quantile(0.0), -2.0);
  EXPECT_NEAR(histogram.quantile(0.8).value(), 5.0, kWithin * 5.0);
  EXPECT_EQ(histogram.quantile(1.0), 1e12);
}

}  // namespace
}  // namespace orthonav
