#include <gtest/gtest.h>

#include "render/shapes.h"
#include "render/vulkan/mesh_cache.h"
#include "tests/render/test_renderer.h"
#include "tests/support/allocation_count.h"
#include "tests/support/test_device.h"

namespace orthonav::render {
namespace {

Scene moving_scene(float offset) {
  static const auto mesh = std::make_shared<const MeshData>(make_sphere(0.05f));
  Scene scene;
  MeshItem item;
  item.label = 201;
  item.mesh = mesh;
  item.style = MeshStyle::kRim;
  item.world_from_model = placed_at({offset, 0, -1});
  scene.meshes.push_back(item);
  LineItem line;
  line.points = {{offset, 0, -1}, {0.2f, 0.1f, -1}, {0.1f, 0.2f, -1}};
  line.dash_m = 0.01f;
  scene.lines.push_back(line);
  scene.triangles.push_back({501, {Float3{offset, 0, -1}, {0.1f, 0, -1}, {0, 0.1f, -1}}, {}});
  TextItem text;
  text.position = {offset, 0, -1};
  text.runs = {{"12.4°", {}}};
  scene.texts.push_back(text);
  return scene;
}

TEST(FrameLoop, AllocatesNothingAfterTheFirstFrames) {
  RendererOptions options;
  options.width_px = 200;
  options.height_px = 120;
  options.device = test::test_device();
  options.cache_folder = "";
  const auto made = Renderer::create(options);
  ASSERT_TRUE(test::is_ok(made));
  Renderer& renderer = **made;
  const std::vector<View> eyes = stereo_pair(TestRenderer::straight_ahead());
  const std::vector<Scene> scenes = {moving_scene(0.00f), moving_scene(0.03f), moving_scene(0.05f)};
  std::vector<RgbaImage> images;
  for (const Scene& scene : scenes) {
    ASSERT_TRUE(test::is_ok(renderer.draw(scene, eyes, {}, images)));
  }
  const std::size_t before = test::allocation_count();
  bool drawn = true;
  for (int i = 0; i < 6; ++i) {
    drawn = renderer.draw(scenes[i % 3], eyes, {}, images).ok() && drawn;
  }
  const std::size_t after = test::allocation_count();
  EXPECT_TRUE(drawn);
  EXPECT_EQ(after, before);
  const Scene copy = scenes[0];
  EXPECT_GT(test::allocation_count(), after)
      << "the twin: the counter counts " << copy.lines.size();
}

// The layer allocates all the time; what it says about such a loop is heard here instead.
TEST(FrameLoop, IsValid) {
  TestRenderer renderer;
  const std::vector<View> eyes = stereo_pair(TestRenderer::straight_ahead());
  std::vector<RgbaImage> images;
  for (int i = 0; i < 9; ++i) {
    const Scene scene = moving_scene(0.02f * static_cast<float>(i % 3));
    EXPECT_TRUE(test::is_ok(renderer->draw(scene, eyes, {}, images)));
  }
}

TEST(FrameLoop, TellsARefusalWhenMemoryForTheImagesIsMissing) {
  TestRenderer renderer;
  const std::vector<View> views = {TestRenderer::straight_ahead()};
  const Scene scene = moving_scene(0);
  std::vector<RgbaImage> images;
  ASSERT_TRUE(test::is_ok(renderer->draw(scene, views, {}, images)));
  images.clear();
  Status drawn;
  {
    const test::AllocationLimit limit(50000);  // an image has 96000 bytes
    drawn = renderer->draw(scene, views, {}, images);
  }
  EXPECT_EQ(test::error_of(drawn), "renderer: out of host memory");
  EXPECT_TRUE(test::is_ok(renderer->draw(scene, views, {}, images)));
}

TEST(FrameLoop, KeepsNoMeshAlive) {
  TestRenderer renderer;
  auto mesh = std::make_shared<const MeshData>(make_sphere(0.05f));
  const std::weak_ptr<const MeshData> watched = mesh;
  Scene scene;
  scene.meshes.push_back({});
  scene.meshes[0].mesh = std::move(mesh);
  scene.meshes[0].world_from_model = placed_at({0, 0, -1});
  renderer.draw(scene, TestRenderer::straight_ahead());
  EXPECT_FALSE(watched.expired()) << "the twin: the scene keeps it";
  scene.meshes.clear();
  EXPECT_TRUE(watched.expired());
}

TEST(FrameLoop, TellsWhereItsTimeWent) {
  TestRenderer renderer;
  renderer.draw(moving_scene(0), TestRenderer::straight_ahead());
  const FrameTiming timing = renderer->last_timing();
  EXPECT_GT(timing.gpu_ms, 0);
  EXPECT_GT(timing.record_ms, 0);
  EXPECT_GE(timing.total_ms, timing.gpu_ms + timing.record_ms);
}

class MeshCacheTest : public ::testing::Test {
 protected:
  SilentValidation validation_;
  Instance instance_{true, validation_.sink()};
  Device device_{choose_device(instance_, test::test_device()).value()};
  Commands commands_{device_};
  MeshCache cache_;
};

TEST_F(MeshCacheTest, KeepsOneCopyAMeshAndDropsItWithItsLastOwner) {
  auto mesh = std::make_shared<const MeshData>(make_sphere(0.05f));
  EXPECT_FALSE(cache_.touch(mesh));
  EXPECT_TRUE(test::is_ok(cache_.add(device_, commands_, mesh)));
  EXPECT_TRUE(cache_.touch(mesh));
  cache_.end_frame();
  EXPECT_EQ(cache_.size(), 1u);
  ASSERT_NE(cache_.find(mesh), nullptr);
  EXPECT_EQ(cache_.find(mesh)->levels.front().index_count, mesh->indices.size());
  mesh.reset();
  cache_.end_frame();
  EXPECT_EQ(cache_.size(), 0u);
}

TEST_F(MeshCacheTest, DropsWhatIsNotDrawnForLong) {
  const auto drawn = std::make_shared<const MeshData>(make_sphere(0.05f));
  const auto idle = std::make_shared<const MeshData>(make_sphere(0.06f));
  EXPECT_TRUE(test::is_ok(cache_.add(device_, commands_, drawn)));
  EXPECT_TRUE(test::is_ok(cache_.add(device_, commands_, idle)));
  for (int frame = 0; frame < 400; ++frame) {
    cache_.touch(drawn);
    cache_.end_frame();
  }
  EXPECT_NE(cache_.find(drawn), nullptr);
  EXPECT_EQ(cache_.find(idle), nullptr);
}

}  // namespace
}  // namespace orthonav::render
