#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "render/float3.h"
#include "render/thinned.h"
#include "tests/render/test_renderer.h"

namespace orthonav::render {
namespace {

constexpr Float3 kEye = {0, 0, 0};
constexpr float kAngle_rad = 1e-4f;

std::vector<Float3> spiral(int points) {
  std::vector<Float3> out;
  for (int i = 0; i < points; ++i) {
    const float t = static_cast<float>(i) / static_cast<float>(points);
    const float angle_rad = 6 * 2 * std::numbers::pi_v<float> * t;
    out.push_back({0.1f * t * std::cos(angle_rad), 0.1f * t * std::sin(angle_rad), -0.5f});
  }
  return out;
}

float distance(Float3 p, Float3 a, Float3 b) {
  const float t = std::clamp(dot(p - a, b - a) / dot(b - a, b - a), 0.0f, 1.0f);
  return length(p - a - t * (b - a));
}

TEST(Thinned, KeepsTheLineWithinTheAngle) {
  const std::vector<Float3> points = spiral(3000);
  std::vector<Float3> kept;
  thin(points, {&kEye, 1}, kAngle_rad, kept);
  EXPECT_LT(kept.size(), points.size() / 2);
  EXPECT_GT(kept.size(), 100u);
  EXPECT_EQ(kept.front(), points.front());
  EXPECT_EQ(kept.back(), points.back());
  for (const Float3 p : points) {
    float nearest = 1;
    for (std::size_t i = 1; i < kept.size(); ++i) {
      nearest = std::min(nearest, distance(p, kept[i - 1], kept[i]));
    }
    EXPECT_LE(nearest, 1.01f * kAngle_rad * length(p));
  }
}

TEST(Thinned, KeepsEveryPointWhereNoAngleIsAllowed) {
  const std::vector<Float3> points = spiral(300);
  std::vector<Float3> kept;
  thin(points, {&kEye, 1}, 0, kept);
  EXPECT_EQ(kept, points);
  thin({}, {&kEye, 1}, kAngle_rad, kept);
  EXPECT_TRUE(kept.empty());
}

TEST(Thinned, TurnsBackWhereTheLineDoes) {
  const std::vector<Float3> there_and_back = {
      {0, 0, -1}, {0.1f, 0, -1}, {0.2f, 0, -1}, {0.1f, 0, -1}, {0, 0, -1}};
  std::vector<Float3> kept;
  thin(there_and_back, {&kEye, 1}, kAngle_rad, kept);
  ASSERT_EQ(kept.size(), 3u);
  EXPECT_EQ(kept[1], there_and_back[2]);
}

TEST(GentleBends, AreNeitherCornersNorPartsThatPointAtAnEye) {
  const Float3 a = {-0.01f, 0, -1};
  const Float3 b = {0, 0, -1};
  const auto bends = [&](Float3 c) { return bends_gently(a, b, c, {&kEye, 1}); };
  EXPECT_TRUE(bends({0.01f, 0, -1}));
  EXPECT_TRUE(bends({0.01f, 0.002f, -1}));
  EXPECT_FALSE(bends({0.01f, 0.003f, -1}));
  EXPECT_FALSE(bends({-0.01f, 0, -1}));
  EXPECT_FALSE(bends({0.001f, 0, -1.01f}));
  EXPECT_FALSE(bends(b));
}

/// Whatever is left out and however runs are drawn, a line of many points covers what the same line
/// covers in pieces short enough to be drawn in full.
TEST(LongLine, CoversWhatItsPiecesDo) {
  TestRenderer renderer(640, 400);
  const View view = TestRenderer::straight_ahead();
  std::vector<Float3> points = spiral(2000);
  points.insert(points.begin() + 1000, {0.15f, 0.1f, -0.5f});  // two sharp corners
  Scene whole;
  whole.lines.push_back({401, points, 0.003f, {}, false, 0});
  Scene pieces;
  for (std::size_t i = 0; i + 1 < points.size(); i += 200) {
    const std::size_t end = std::min(i + 201, points.size());
    pieces.lines.push_back({401, {points.begin() + i, points.begin() + end}, 0.003f, {}, false, 0});
  }
  const LabelImage expected = renderer.labels(pieces, view);
  const LabelImage actual = renderer.labels(whole, view);
  const std::size_t covered = extent_of(expected, 401)->pixels;
  // Only pixels whose centre lies at the very outline may change their mind.
  EXPECT_LT(compare_labels(expected, actual).outside, covered / 50);
  EXPECT_GT(covered, 3000u);
  whole.lines[0].width_m = 0.0028f;
  EXPECT_GT(compare_labels(expected, renderer.labels(whole, view)).outside, covered / 50)
      << "the twin";
}

}  // namespace
}  // namespace orthonav::render
