#include <gmock/gmock.h>

#include "render/decimated.h"
#include "render/float3.h"
#include "render/shapes.h"
#include "render/vulkan/mesh_cache.h"
#include "tests/render/test_renderer.h"
#include "tests/render/test_scenes.h"
#include "tests/support/test_device.h"

namespace orthonav::render {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

Scene text_scene(const std::string& text) {
  Scene scene;
  TextItem item;
  item.label = 601;
  item.position = {0, 0, -1};
  item.height_m = 0.04f;
  item.runs = {{text, {}}};
  scene.texts.push_back(item);
  return scene;
}

std::size_t pixels_of(const LabelImage& image, Label label) {
  const auto extent = extent_of(image, label);
  return extent ? extent->pixels : 0;
}

TEST(Notes, NameACharacterThatTheFontLacksOnce) {
  TestRenderer renderer;
  const View view = TestRenderer::straight_ahead();
  const Scene scene = text_scene("1\u4e2d2\u4e2d");
  renderer.draw(scene, view);
  renderer.draw(scene, view);
  EXPECT_THAT(renderer->notes(),
              ElementsAre("scene: text 0 (label 601): the font has no U+4E2D, drawn as a box"));
  const std::size_t digits = pixels_of(renderer.labels(text_scene("12"), view), 601);
  EXPECT_GT(pixels_of(renderer.labels(scene, view), 601), digits + 20) << "the boxes are there";
}

TEST(Notes, AreNoneForWhatIsDrawnAsAskedFor) {
  TestRenderer renderer;
  renderer.draw(crowded_scene(), TestRenderer::straight_ahead());
  EXPECT_THAT(renderer->notes(), IsEmpty());
}

TEST(LongText, IsDrawnToItsEnd) {
  TestRenderer renderer;
  Scene scene = text_scene(std::string(10'000, '8'));
  scene.texts[0].align = TextAlign::kRight;
  const View view = TestRenderer::straight_ahead();
  const auto all = extent_of(renderer.labels(scene, view), 601);
  ASSERT_TRUE(all);
  EXPECT_EQ(all->left_px, 0);
  EXPECT_NEAR(all->right_px, 100, 2);
  // The last digit is its own, not one of the crowd.
  scene.texts[0].runs[0].text.back() = '1';
  EXPECT_NE(extent_of(renderer.labels(scene, view), 601)->pixels, all->pixels);
}

float farthest_from_sphere(const MeshData& mesh, float radius_m) {
  float worst = 0;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const Float3 middle =
        (1.0f / 3) * (mesh.positions[mesh.indices[i]] + mesh.positions[mesh.indices[i + 1]] +
                      mesh.positions[mesh.indices[i + 2]]);
    worst = std::max(worst, std::abs(length(middle) - radius_m));
  }
  return worst;
}

TEST(Simplified, LeavesOutTrianglesAndKeepsTheShape) {
  const MeshData fine = make_sphere(0.035f, 180, 90);
  const MeshData fewer = simplified(fine, 1000, 2e-5f);
  EXPECT_LT(fewer.indices.size(), fine.indices.size() * 2 / 3);
  // The error is a mean over triangles; one alone may be farther off.
  EXPECT_LT(farthest_from_sphere(fewer, 0.035f), 8e-5f);
  EXPECT_GT(farthest_from_sphere(simplified(fine, 100, 1e-3f), 0.035f), 8e-5f) << "the twin";
  EXPECT_EQ(simplified(fine, 1000, 0).indices.size(), fine.indices.size());
  EXPECT_EQ(simplified(fine, 1'000'000, 1).indices.size(), fine.indices.size());
}

TEST(Decimated, MakesLooseTrianglesFewerToo) {
  const MeshData sphere = make_sphere(0.035f, 180, 90);
  MeshData loose;
  for (const std::uint32_t index : sphere.indices) {
    loose.indices.push_back(static_cast<std::uint32_t>(loose.positions.size()));
    loose.positions.push_back(sphere.positions[index]);
    loose.normals.push_back(sphere.normals[index]);
  }
  const MeshData fewer = decimated(loose, 2000);
  EXPECT_LE(fewer.indices.size(), 3 * 2500u);
  EXPECT_GT(fewer.indices.size(), 3 * 1000u);
  EXPECT_LT(farthest_from_sphere(fewer, 0.035f), 5e-4f);
}

TEST(Coarser, HasTheTrianglesAskedForAndSaysHowFarItIsOff) {
  const MeshData fine = make_sphere(0.035f, 60, 30);
  const std::size_t half = fine.indices.size() / 6;
  for (const bool joined : {false, true}) {
    const Coarser fewer = coarser(fine, half, joined);
    EXPECT_LE(fewer.mesh.indices.size(), 3 * half + 30);
    EXPECT_GT(fewer.error_m, 1e-6f);
    EXPECT_LT(farthest_from_sphere(fewer.mesh, 0.035f),
              farthest_from_sphere(fine, 0.035f) + 4 * fewer.error_m);
  }
  EXPECT_TRUE(coarser({}, 10, true).mesh.indices.empty());
}

TEST(Coarser, IsChosenByTheErrorThatIsAllowed) {
  SilentValidation validation;
  const Instance instance(true, validation.sink());
  const Device device(choose_device(instance, test::test_device()).value());
  Commands commands(device);
  MeshCache cache;
  const auto mesh = std::make_shared<const MeshData>(make_sphere(0.05f, 60, 30));
  MeshDetail detail;
  detail.error = 2e-5f;
  EXPECT_TRUE(test::is_ok(cache.add(device, commands, mesh, detail)));
  const GpuMesh& copy = *cache.find(mesh);
  ASSERT_EQ(copy.levels.size(), 4u);
  EXPECT_EQ(copy.levels[0].index_count, mesh->indices.size());
  EXPECT_EQ(copy.levels[0].error, 0);
  for (std::size_t i = 1; i < copy.levels.size(); ++i) {
    EXPECT_LT(copy.levels[i].index_count, copy.levels[i - 1].index_count);
    EXPECT_GT(copy.levels[i].error, copy.levels[i - 1].error);
    EXPECT_EQ(copy.level_within(copy.levels[i].error), i);
  }
  EXPECT_EQ(copy.level_within(0), 0u);
  const auto whole = std::make_shared<const MeshData>(*mesh);
  EXPECT_TRUE(test::is_ok(cache.add(device, commands, whole, {})));
  EXPECT_EQ(cache.find(whole)->levels.size(), 1u) << "every triangle was asked for";
}

TEST(HugeMesh, IsDrawnWithFewerTrianglesAndANote) {
  TestRenderer renderer;
  Scene scene = sphere_scene(MeshStyle::kRim, {}, {0, 0, -1}, 201);
  const View view = TestRenderer::straight_ahead();
  const LabelImage plain = renderer.labels(scene, view);
  // Bumps of a tenth of a millimetre, as noise leaves them, which no error of 20 um lets go.
  MeshData bumpy = make_sphere(0.05f, 720, 360);
  for (std::size_t i = 0; i < bumpy.positions.size(); ++i) {
    bumpy.positions[i] = (1 + 0.002f * static_cast<float>(i % 2)) * bumpy.positions[i];
  }
  scene.meshes[0].mesh = std::make_shared<MeshData>(bumpy);
  const LabelImage labels = renderer.labels(scene, view);
  ASSERT_EQ(renderer->notes().size(), 1u);
  EXPECT_THAT(renderer->notes()[0],
              ::testing::MatchesRegex("scene: mesh 0 \\(label 201\\): drawn with [0-9]+ of its "
                                      "516960 triangles, limit 250000"));
  EXPECT_NEAR(static_cast<double>(pixels_of(labels, 201)),
              static_cast<double>(pixels_of(plain, 201)), 12.0);
}

TEST(HugeMesh, HasNoMoreTrianglesThanTheLimitWhateverTheError) {
  SilentValidation validation;
  const Instance instance(true, validation.sink());
  const Device device(choose_device(instance, test::test_device()).value());
  Commands commands(device);
  MeshCache cache;
  const auto mesh = std::make_shared<const MeshData>(make_sphere(0.05f, 180, 90));
  MeshDetail detail;
  detail.enough_triangles = 1000;
  detail.most_triangles = 4000;
  EXPECT_TRUE(test::is_ok(cache.add(device, commands, mesh, detail)));
  EXPECT_LE(cache.find(mesh)->levels.front().index_count, 3 * 4000u);
  EXPECT_GT(cache.find(mesh)->levels.front().index_count, 3 * 3000u);
}

}  // namespace
}  // namespace orthonav::render
