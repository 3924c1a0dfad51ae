#include "base/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

namespace orthonav {
namespace {

TEST(Random, SeedsLikeThePublishedSplitmix) {
  // First outputs of Vigna's splitmix64.c for the state 1234567.
  std::uint64_t state = 1234567;
  EXPECT_EQ(splitmix64(state), 6457827717110365317ULL);
  EXPECT_EQ(splitmix64(state), 3203168211198807973ULL);
}

TEST(Random, RepeatsItselfAndPartsWithTheSeed) {
  Random a(7);
  Random b(7);
  Random c(8);
  int same = 0;
  for (int i = 0; i < 100; ++i) {
    const std::uint64_t word = a.next();
    EXPECT_EQ(word, b.next());
    same += word == c.next() ? 1 : 0;
  }
  EXPECT_EQ(same, 0);
}

TEST(Random, ForksDependOnNameAndSeedAlone) {
  Random drawn(3);
  const Random fresh(3);
  for (int i = 0; i < 10; ++i) {
    drawn.next();
  }
  EXPECT_EQ(drawn.fork("head").next(), fresh.fork("head").next());
  std::set<std::uint64_t> firsts;
  for (std::uint64_t n = 0; n < 1000; ++n) {
    firsts.insert(fresh.fork(n).next());
  }
  firsts.insert(fresh.fork("head").next());
  firsts.insert(fresh.fork("hand").next());
  firsts.insert(fresh.fork(1).fork(2).next());
  EXPECT_EQ(firsts.size(), 1003U);
}

TEST(Random, UniformFillsItsInterval) {
  Random random(11);
  std::vector<int> bins(10);
  constexpr int kDraws = 100000;
  for (int i = 0; i < kDraws; ++i) {
    const double u = random.uniform();
    ASSERT_GE(u, 0.0);
    ASSERT_LT(u, 1.0);
    ++bins[static_cast<std::size_t>(u * 10.0)];
  }
  // Five standard deviations of a binomial count: 5·sqrt(1e5·0.1·0.9).
  for (const int count : bins) {
    EXPECT_NEAR(count, kDraws / 10, 475);
  }
}

TEST(Random, NormalHasTheMomentsOfANormal) {
  Random random(5);
  constexpr int kDraws = 200000;
  double sum = 0.0;
  double squares = 0.0;
  double fourths = 0.0;
  int beyond_two = 0;
  for (int i = 0; i < kDraws; ++i) {
    const double x = random.normal();
    sum += x;
    squares += x * x;
    fourths += x * x * x * x;
    beyond_two += std::abs(x) > 2.0 ? 1 : 0;
  }
  // Five standard errors each.
  EXPECT_NEAR(sum / kDraws, 0.0, 5.0 / std::sqrt(kDraws));
  EXPECT_NEAR(squares / kDraws, 1.0, 5.0 * std::sqrt(2.0 / kDraws));
  EXPECT_NEAR(fourths / kDraws, 3.0, 5.0 * std::sqrt(96.0 / kDraws));
  EXPECT_NEAR(static_cast<double>(beyond_two) / kDraws, 0.0455003,
              5.0 * std::sqrt(0.0455 * 0.9545 / kDraws));
}

TEST(Random, QuantileInvertsTheDistribution) {
  // erfc is an independent implementation of the same function.
  for (const double p : {1e-300, 1e-20, 1e-9, 1e-3, 0.02, 0.0749, 0.0751, 0.3, 0.5, 0.7, 0.95}) {
    const double x = normal_quantile(p);
    EXPECT_NEAR(0.5 * std::erfc(-x / std::sqrt(2.0)) / p, 1.0, 1e-12) << p;
  }
  EXPECT_NEAR(normal_quantile(0.975), 1.959963984540054, 1e-14);
}

}  // namespace
}  // namespace orthonav
