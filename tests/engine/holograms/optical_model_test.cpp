#include "engine/holograms/optical_model.h"

#include <gtest/gtest.h>

#include <numbers>

namespace orthonav::engine {
namespace {

RgbaImage plain(std::uint8_t grey) {
  return {2, 1, {grey, grey, grey, 255, grey, grey, grey, 255}};
}

constexpr render::Label kLabel = 301;
const LabelImage kLabels{2, 1, {kLabel, 0}};

TEST(OpticalModel, ContrastIsTheLuminanceWithByThatWithout) {
  const OpticalModel model{400.0, 1000.0, 0.5};
  // A white sheet under 1000 lux has 1000 / pi cd/m2, half of it passes.
  const double behind = 0.5 * 1000.0 / std::numbers::pi;
  const auto found = contrasts(plain(255), kLabels, plain(255), model);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].label, kLabel);
  EXPECT_EQ(found[0].pixels, 1);
  EXPECT_NEAR(found[0].median, 1.0 + 400.0 / behind, 1e-9);
  // sRGB 188 is half the light.
  EXPECT_NEAR(contrasts(plain(188), kLabels, plain(255), model)[0].median, 1.0 + 200.0 / behind,
              0.01);
  EXPECT_NEAR(contrasts(plain(0), kLabels, plain(255), model)[0].median, 1.0, 1e-12) << "invisible";
}

TEST(OpticalModel, MoreLightInTheRoomTakesContrast) {
  double last = 1e9;
  for (const double lux : {100.0, 1000.0, 10'000.0, 100'000.0}) {
    const double now = contrasts(plain(255), kLabels, plain(120), {500.0, lux, 0.4})[0].median;
    EXPECT_LT(now, last);
    EXPECT_GT(now, 1.0);
    last = now;
  }
}

TEST(OpticalModel, WhatTheEyeSeesIsDisplayAndWorldTogether) {
  const OpticalModel model{400.0, 1000.0, 0.5};
  const RgbaImage black = through_combiner(plain(0), plain(0), model);
  EXPECT_EQ(black.pixels[0], 0);
  RgbaImage light = plain(0);
  light.pixels[0] = light.pixels[1] = light.pixels[2] = 255;
  const RgbaImage seen = through_combiner(light, plain(255), model);
  EXPECT_EQ(seen.pixels[0], 255) << "the brightest is white";
  EXPECT_LT(seen.pixels[4], 160) << "the world alone is darker";
  EXPECT_GT(seen.pixels[4], 120);
  EXPECT_EQ(seen.pixels[3], 255);
}

TEST(OpticalModel, NamesEveryProblem) {
  EXPECT_TRUE(OpticalModel{}.check().empty());
  EXPECT_EQ((OpticalModel{0.0, -1.0, 1.5}).check().size(), 3u);
}

}  // namespace
}  // namespace orthonav::engine
