#include <gmock/gmock.h>

#include <array>

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

/// The triangles of a level alone.
MeshData level_of(const MeshData& mesh, std::size_t level) {
  MeshData out = mesh;
  out.indices = mesh.levels.at(level).indices;
  return out;
}

TEST(Prepared, LeavesOutTrianglesAndKeepsTheShape) {
  const MeshData fine = make_sphere(0.035f, 180, 90);
  const auto finest = [&](std::size_t enough, float error) {
    return level_of(*prepared(fine, {.error = error, .enough_triangles = enough}), 0);
  };
  const MeshData fewer = finest(1000, 2e-5f);
  EXPECT_LT(fewer.indices.size(), fine.indices.size() * 2 / 3);
  // The error is a mean over triangles; one alone may be farther off.
  EXPECT_LT(farthest_from_sphere(fewer, 0.035f), 8e-5f);
  EXPECT_GT(farthest_from_sphere(finest(100, 1e-3f), 0.035f), 8e-5f) << "the twin";
  EXPECT_EQ(finest(1000, 0).indices.size(), fine.indices.size());
  EXPECT_EQ(finest(1'000'000, 1).indices.size(), fine.indices.size());
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

TEST(Prepared, SaysHowFarEachLevelIsOff) {
  const MeshData fine = make_sphere(0.035f, 60, 30);
  for (const std::size_t enough : {std::size_t{100}, std::size_t{14'000}}) {
    const auto mesh = prepared(fine, {.error = 0, .enough_triangles = enough});
    ASSERT_EQ(mesh->levels.size(), 4u);
    EXPECT_EQ(mesh->levels[0].error, 0);
    constexpr std::array kShares = {1.0, 0.7, 0.5, 0.3};
    for (std::size_t i = 1; i < mesh->levels.size(); ++i) {
      const MeshLevel& level = mesh->levels[i];
      EXPECT_LE(static_cast<double>(level.indices.size()),
                kShares[i] * static_cast<double>(fine.indices.size()) + 30);
      EXPECT_GT(level.error, std::max(mesh->levels[i - 1].error, 1e-6f));
      EXPECT_LT(farthest_from_sphere(level_of(*mesh, i), 0.035f),
                farthest_from_sphere(fine, 0.035f) + 4 * level.error);
    }
  }
  EXPECT_TRUE(prepared({})->levels.empty());
}

TEST(Prepared, LeavesABadMeshToTheRenderer) {
  MeshData mesh = make_sphere(0.035f);
  mesh.indices[5] = 100'000;
  EXPECT_TRUE(prepared(mesh)->levels.empty());
}

TEST(Levels, AreChosenByTheErrorThatIsAllowed) {
  SilentValidation validation;
  const Instance instance(true, validation.sink());
  const Device device(choose_device(instance, test::test_device()).value());
  Commands commands(device);
  const auto mesh = prepared(make_sphere(0.05f, 60, 30));
  MeshCache cache;
  EXPECT_TRUE(test::is_ok(cache.add(device, commands, mesh)));
  const GpuMesh& copy = *cache.find(mesh);
  ASSERT_EQ(copy.levels.size(), 4u);
  for (std::size_t i = 0; i < copy.levels.size(); ++i) {
    EXPECT_EQ(copy.levels[i].index_count, mesh->levels[i].indices.size());
    EXPECT_EQ(copy.level_within(copy.levels[i].error), i);
  }
  MeshCache whole({.every_triangle = true});
  EXPECT_TRUE(test::is_ok(whole.add(device, commands, mesh)));
  EXPECT_EQ(whole.find(mesh)->levels.size(), 1u);
}

/// From afar, a prepared surface is drawn with fewer of its triangles, any other with all of them:
/// no frame waits for levels to be made.
TEST(Levels, AreNeverMadeByDrawing) {
  Scene scene = sphere_scene(MeshStyle::kSolid, {1, 1, 1, 1}, {0, 0, -3}, 201);
  const MeshData sphere = make_sphere(0.05f, 60, 30);
  const auto pixels = [&](std::shared_ptr<const MeshData> mesh, bool every_triangle) {
    RendererOptions options;
    options.width_px = options.height_px = 128;
    options.device = test::test_device();
    options.cache_folder = "";
    options.every_triangle = every_triangle;
    scene.meshes[0].mesh = std::move(mesh);
    auto renderer = Renderer::create(options);
    EXPECT_TRUE(test::is_ok(renderer));
    std::vector<RgbaImage> images;
    EXPECT_TRUE(
        test::is_ok((*renderer)->draw(scene, {TestRenderer::straight_ahead()}, {}, images)));
    return images.at(0).pixels;
  };
  // Levels that are told from the surface in any picture: most of it is missing.
  MeshData holed = *prepared(sphere);
  for (std::size_t i = 1; i < holed.levels.size(); ++i) {
    holed.levels[i].indices.resize(30);
  }
  const auto whole = pixels(std::make_shared<const MeshData>(sphere), true);
  EXPECT_EQ(pixels(std::make_shared<const MeshData>(sphere), false), whole);
  EXPECT_EQ(pixels(std::make_shared<const MeshData>(holed), true), whole);
  EXPECT_NE(pixels(std::make_shared<const MeshData>(holed), false), whole) << "the twin";
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
  scene.meshes[0].mesh = prepared(bumpy);
  const LabelImage labels = renderer.labels(scene, view);
  ASSERT_EQ(renderer->notes().size(), 1u);
  EXPECT_THAT(renderer->notes()[0],
              ::testing::MatchesRegex("scene: mesh 0 \\(label 201\\): drawn with [0-9]+ of its "
                                      "516960 triangles, limit 250000"));
  EXPECT_NEAR(static_cast<double>(pixels_of(labels, 201)),
              static_cast<double>(pixels_of(plain, 201)), 12.0);
}

TEST(HugeMesh, HasNoMoreTrianglesThanTheLimitWhateverTheError) {
  const auto mesh = prepared(make_sphere(0.05f, 180, 90),
                             {.error = 0, .enough_triangles = 1000, .most_triangles = 4000});
  EXPECT_LE(mesh->levels.front().indices.size(), 3 * 4000u);
  EXPECT_GT(mesh->levels.front().indices.size(), 3 * 3000u);
}

}  // namespace
}  // namespace orthonav::render
