#include "hal/sim/room/noise.h"

#include <gtest/gtest.h>

#include <cmath>

namespace orthonav::sim {
namespace {

TEST(SmoothNoise, HasItsSdAndNoJumps) {
  const SmoothNoise noise(Random(1), 2.0, 0.05, 0.5);
  double squares = 0.0;
  double largest_step = 0.0;
  constexpr int kSamples = 200000;
  constexpr double kStep_s = 0.01;
  for (int i = 0; i < kSamples; ++i) {
    const double value = noise.at(i * kStep_s);
    squares += value * value;
    largest_step = std::max(largest_step, std::abs(noise.at((i + 1) * kStep_s) - value));
  }
  EXPECT_NEAR(std::sqrt(squares / kSamples), 2.0, 0.05);
  // Twelve sines in step at the fastest rate could not move more.
  EXPECT_LT(largest_step, 12 * 2.0 * std::sqrt(2.0 / 12) * 2 * 3.1416 * 0.5 * kStep_s);
}

TEST(SmoothNoise, IsZeroWithoutSd) {
  EXPECT_EQ(SmoothNoise(Random(1), 0.0, 1.0, 2.0).at(3.3), 0.0);
  EXPECT_EQ(SmoothNoise().at(3.3), 0.0);
}

TEST(MapDrift, GrowsWithTheRootOfTime) {
  double early = 0.0;
  double late = 0.0;
  constexpr int kSeeds = 2000;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const MapDrift drift(Random(seed), 0.001, 0.0, 100.0);
    EXPECT_EQ(drift.at(0.0).translation_m, Vec3{});
    early += drift.at(25.0).translation_m.squared_norm();
    late += drift.at(100.0).translation_m.squared_norm();
  }
  // Five standard errors of a variance of 6,000 draws: 9 %.
  EXPECT_NEAR(early / kSeeds / 3, 25e-6, 2.3e-6);
  EXPECT_NEAR(late / kSeeds / 3, 100e-6, 9.1e-6);
}

TEST(MapDrift, StaysReadablePastItsEnd) {
  const MapDrift drift(Random(1), 0.001, 0.001, 2.0);
  EXPECT_TRUE(drift.at(1e9).translation_m.is_finite());
  EXPECT_EQ(drift.at(-5.0).translation_m, Vec3{});
}

}  // namespace
}  // namespace orthonav::sim
