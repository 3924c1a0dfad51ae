#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "base/srgb.h"
#include "render/shapes.h"
#include "render/vulkan/targets.h"
#include "tests/render/test_renderer.h"
#include "tests/render/test_scenes.h"

namespace orthonav::render {
namespace {

// One metre away, a pixel is 5 mm.
constexpr double kPixel_m2 = 0.005 * 0.005;

/// The area of what is drawn in white, in square metres one metre away.
double area_m2(const RgbaImage& image) {
  double light = 0;
  for (std::size_t i = 0; i < image.pixels.size(); i += 4) {
    light += linear_from_srgb(image.pixels[i] / 255.0);
  }
  return light * kPixel_m2;
}

Scene triangle_scene(const std::array<Float3, 3>& corners) {
  Scene scene;
  scene.triangles.push_back({501, corners, {1, 1, 1, 1}});
  return scene;
}

/// Drawn at nine places within a pixel: the largest error of its area, relative.
double worst_area_error(TestRenderer& renderer, const std::array<Float3, 3>& corners,
                        double expected_m2) {
  double worst = 0;
  for (int i = 0; i < 9; ++i) {
    const Float3 aside = {0.0017f * static_cast<float>(i % 3), 0.0017f * static_cast<float>(i / 3),
                          0};
    std::array<Float3, 3> moved = corners;
    for (Float3& corner : moved) {
      corner = {corner.x + aside.x, corner.y + aside.y, corner.z};
    }
    const double area =
        area_m2(renderer.draw(triangle_scene(moved), TestRenderer::straight_ahead()));
    worst = std::max(worst, std::abs(area / expected_m2 - 1));
  }
  return worst;
}

TEST(Coverage, OfATriangleIsItsAreaWhereverItLies) {
  TestRenderer covered;
  TestRenderer hard(200, 120, Blend::kAdditive, Edges::kHard);
  const std::array<Float3, 3> corners = {{{-0.1f, -0.05f, -1}, {0.13f, 0, -1}, {0.02f, 0.12f, -1}}};
  const double expected_m2 = 0.5 * (0.23 * 0.17 - 0.05 * 0.12);
  EXPECT_LT(worst_area_error(covered, corners, expected_m2), 0.001);
  EXPECT_GT(worst_area_error(hard, corners, expected_m2), 0.001) << "the twin";
}

TEST(Coverage, OfAStripThinnerThanAPixelIsItsThickness) {
  TestRenderer covered;
  TestRenderer hard(200, 120, Blend::kAdditive, Edges::kHard);
  const Scene strip = triangle_scene({{{-0.3f, 0, -1}, {0.3f, 0.031f, -1}, {0.3f, 0.033f, -1}}});
  const auto light_in_column = [&](TestRenderer& renderer) {
    const RgbaImage image = renderer.draw(strip, TestRenderer::straight_ahead());
    double light = 0;
    for (int y = 0; y < image.height_px; ++y) {
      light += linear_from_srgb(pixel(image, 150, y)[0] / 255.0);
    }
    return light;
  };
  // In the middle of that column, 252.5 mm to the right, it is 1.84 mm thick.
  constexpr double kThickness_px = 0.368;
  EXPECT_NEAR(light_in_column(covered), kThickness_px, 0.02);
  EXPECT_GT(std::abs(light_in_column(hard) - kThickness_px), 0.02) << "the twin";
}

TEST(Coverage, LeavesImagesOpaque) {
  for (const Blend blend : {Blend::kAdditive, Blend::kOver}) {
    TestRenderer renderer(200, 120, blend);
    const RgbaImage image = renderer.draw(crowded_scene(), TestRenderer::straight_ahead());
    for (std::size_t i = 3; i < image.pixels.size(); i += 4) {
      ASSERT_EQ(image.pixels[i], 255) << i / 4;
    }
  }
}

TEST(Coverage, OfATranslucentLineIsItsOpacityOnceHoweverItCrossesItself) {
  TestRenderer renderer(200, 120, Blend::kOver);
  Scene scene = line_scene(0.06f, {-0.2f, 0, -1}, {0.2f, 0, -1});
  scene.lines[0].points.push_back({-0.2f, 0.001f, -1});
  scene.lines[0].points.push_back({0.2f, -0.001f, -1});
  scene.lines[0].colour.a = 0.4f;
  const RgbaImage image = renderer.draw(scene, TestRenderer::straight_ahead());
  EXPECT_NEAR(linear_from_srgb(pixel(image, 100, 60)[0] / 255.0), 0.4, 0.01);
}

/// A square of 200 mm that faces the eye, its sides askew to the pixels.
Scene square_scene(float x_m, float y_m) {
  auto mesh = std::make_shared<MeshData>();
  for (int corner = 0; corner < 4; ++corner) {
    const float angle_rad = 0.5f * std::numbers::pi_v<float> * (static_cast<float>(corner) + 0.2f);
    mesh->positions.push_back({0.1414f * std::cos(angle_rad), 0.1414f * std::sin(angle_rad), 0});
    mesh->normals.push_back({0, 0, 1});
  }
  mesh->indices = {0, 1, 2, 0, 2, 3};
  Scene scene;
  MeshItem item;
  item.label = 301;
  item.mesh = mesh;
  item.world_from_model = placed_at({x_m, y_m, -1});
  scene.meshes.push_back(item);
  return scene;
}

/// The spread of its light over nine places within a pixel, relative.
double spread_of_square(TestRenderer& renderer) {
  double least = 1;
  double most = 0;
  for (int i = 0; i < 9; ++i) {
    const Scene scene =
        square_scene(0.0017f * static_cast<float>(i % 3), 0.0017f * static_cast<float>(i / 3));
    const double area = area_m2(renderer.draw(scene, TestRenderer::straight_ahead()));
    least = std::min(least, area);
    most = std::max(most, area);
  }
  return most / least - 1;
}

TEST(Coverage, OfASurfaceIsAsLargeWhereverItLies) {
  TestRenderer covered;
  TestRenderer hard(200, 120, Blend::kAdditive, Edges::kHard);
  EXPECT_LT(spread_of_square(covered), 0.002);
  EXPECT_GT(spread_of_square(hard), 0.002) << "the twin";
}

TEST(Coverage, GivesWayToSamplesWhereAlphaIsSomebodyElses) {
  RendererOptions options;
  EXPECT_EQ(drawn_edges(options), Edges::kCoverage);
  options.blend = Blend::kPremultiplied;
  EXPECT_EQ(drawn_edges(options), Edges::kSamples);
  options.edges = Edges::kHard;
  EXPECT_EQ(drawn_edges(options), Edges::kHard);
}

}  // namespace
}  // namespace orthonav::render
