#include <gtest/gtest.h>

#include <algorithm>

#include "render/shapes.h"
#include "tests/render/test_renderer.h"
#include "tests/render/test_scenes.h"

namespace orthonav::render {
namespace {

TEST(Triangle, ShowsFromBothSides) {
  TestRenderer renderer;
  Scene scene;
  scene.triangles.push_back(
      {501, {Float3{-0.1f, -0.1f, -1}, {0.1f, -0.1f, -1}, {0, 0.1f, -1}}, {}});
  const auto front = extent_of(renderer.labels(scene, TestRenderer::straight_ahead()), 501);
  std::swap(scene.triangles[0].corners[0], scene.triangles[0].corners[1]);
  const auto back = extent_of(renderer.labels(scene, TestRenderer::straight_ahead()), 501);
  ASSERT_TRUE(front && back);
  EXPECT_EQ(front->pixels, back->pixels);
  EXPECT_NEAR(front->centre_x_px, 100, 0.3);
}

TEST(Mesh, TakesItsTintWhereItSaysSo) {
  TestRenderer renderer;
  for (const MeshStyle style : {MeshStyle::kSolid, MeshStyle::kRim}) {
    Scene scene = sphere_scene(style, {1, 0, 0, 1}, {0, 0, -1}, 301);
    scene.meshes[0].tint = {0, 0, 1, 1};
    auto left = std::make_shared<MeshData>(*scene.meshes[0].mesh);
    for (const Float3 p : left->positions) {
      left->tints.push_back(p.x < 0 ? 1.0f : 0.0f);
    }
    const RgbaImage plain = renderer.draw(scene, TestRenderer::straight_ahead());
    scene.meshes[0].mesh = left;
    const RgbaImage image = renderer.draw(scene, TestRenderer::straight_ahead());
    EXPECT_EQ(pixel(image, 106, 60), pixel(plain, 106, 60));
    const auto there = pixel(image, 94, 60);
    EXPECT_EQ(there[0], 0);
    EXPECT_EQ(there[2], pixel(plain, 94, 60)[0]);
  }
}

TEST(Mesh, SolidHidesALineBehindItAndAVeilDoesNot) {
  TestRenderer renderer;
  Scene scene = sphere_scene(MeshStyle::kSolid, {1, 0, 0, 1}, {0, 0, -1}, 301);
  const Scene line = line_scene(0.02f, {-0.3f, 0, -2}, {0.3f, 0, -2});
  scene.lines = line.lines;
  const auto middle = [&] {
    return renderer.labels(scene, TestRenderer::straight_ahead()).labels[60 * 200 + 100];
  };
  EXPECT_EQ(middle(), 301u);
  scene.meshes[0].style = MeshStyle::kRim;
  EXPECT_EQ(middle(), 401u);
  scene.meshes[0].style = MeshStyle::kSolid;
  scene.meshes[0].colour.a = 0.5f;
  EXPECT_EQ(middle(), 401u);
}

TEST(Mesh, RimIsBrightAtTheEdgeAndThinInside) {
  TestRenderer renderer;
  Scene scene = sphere_scene(MeshStyle::kRim, {1, 1, 1, 0.35f}, {0, 0, -0.4f}, 201);
  scene.meshes[0].mesh = std::make_shared<MeshData>(make_sphere(0.05f, 192, 96));
  const RgbaImage image = renderer.draw(scene, TestRenderer::straight_ahead());
  int brightest = 0;
  for (int x = 0; x < 100; ++x) {
    brightest = std::max(brightest, pixel(image, x, 60)[0]);
  }
  EXPECT_GT(brightest, 140);  // of a pixel that the edge covers in part
  EXPECT_LT(pixel(image, 100, 60)[0], 70);
  EXPECT_GT(pixel(image, 100, 60)[0], 20) << "there is an inside";
}

TEST(Mesh, VeilShowsOnlyItsNearestSurface) {
  TestRenderer renderer;
  Scene one = sphere_scene(MeshStyle::kRim, {1, 1, 1, 0.35f}, {0, 0, -1}, 201);
  Scene two = one;
  two.meshes.push_back(one.meshes[0]);
  two.meshes[1].world_from_model = placed_at({0, 0, -2}, 1.0f);
  EXPECT_EQ(pixel(renderer.draw(one, TestRenderer::straight_ahead()), 100, 60),
            pixel(renderer.draw(two, TestRenderer::straight_ahead()), 100, 60));
}

}  // namespace
}  // namespace orthonav::render
