#include "render/vulkan/pipeline_cache.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "tests/render/test_renderer.h"
#include "tests/render/test_scenes.h"
#include "tests/support/test_device.h"

namespace orthonav::render {
namespace {

class PipelineCacheTest : public ::testing::Test {
 protected:
  PipelineCacheTest() { std::filesystem::remove_all(folder_); }
  ~PipelineCacheTest() override { std::filesystem::remove_all(folder_); }

  /// The path of a cache that was opened and closed.
  std::string kept() {
    const PipelineCache cache(device_, physical_, folder_);
    return cache.path();
  }
  bool is_read() { return PipelineCache(device_, physical_, folder_).was_read(); }

  SilentValidation validation_;
  Instance instance_{true, validation_.sink()};
  VkPhysicalDevice physical_ = choose_device(instance_, test::test_device()).value();
  Device device_{physical_};
  std::string folder_ = ::testing::TempDir() + "orthonav_pipeline_cache/deeper";
};

TEST_F(PipelineCacheTest, IsReadByTheNextStart) {
  EXPECT_FALSE(is_read());
  EXPECT_TRUE(is_read());
}

TEST_F(PipelineCacheTest, CountsForNothingWhenChangedOrCutOff) {
  const std::string path = kept();
  const auto size = std::filesystem::file_size(path);
  std::fstream(path, std::ios::in | std::ios::out | std::ios::binary).seekp(30).put('\x5a');
  EXPECT_FALSE(is_read());  // and made anew
  EXPECT_TRUE(is_read());
  std::filesystem::resize_file(path, size - 1);
  EXPECT_FALSE(is_read());
  std::filesystem::resize_file(path, 5);
  EXPECT_FALSE(is_read());
  EXPECT_TRUE(is_read());
}

TEST_F(PipelineCacheTest, IsNoReasonToFailWhereNothingCanBeWritten) {
  const PipelineCache nowhere(device_, physical_, "/proc/none");
  EXPECT_NE(nowhere.get(), VK_NULL_HANDLE);
  const PipelineCache none(device_, physical_, "");
  EXPECT_NE(none.get(), VK_NULL_HANDLE);
  EXPECT_EQ(none.path(), "");
}

TEST_F(PipelineCacheTest, LeavesTheRenderersPicturesAlone) {
  RendererOptions options;
  options.width_px = 200;
  options.height_px = 120;
  options.device = test::test_device();
  options.cache_folder = folder_;
  std::vector<RgbaImage> first;
  std::vector<RgbaImage> second;
  for (auto* images : {&first, &second}) {
    const auto renderer = Renderer::create(options);
    ASSERT_TRUE(test::is_ok(renderer));
    ASSERT_TRUE(test::is_ok(
        (*renderer)->draw(crowded_scene(), {TestRenderer::straight_ahead()}, {}, *images)));
  }
  EXPECT_FALSE(std::filesystem::is_empty(folder_));
  EXPECT_EQ(first, second);
}

// In a process of its own, since it changes the environment.
TEST(UserCacheFolderDeathTest, IsWhereTheSpecificationSays) {
  EXPECT_EXIT(
      {
        setenv("HOME", "/home/someone", 1);
        setenv("XDG_CACHE_HOME", "/var/tmp/cache", 1);
        const bool given = user_cache_folder() == "/var/tmp/cache/orthonav";
        setenv("XDG_CACHE_HOME", "relative", 1);
        const bool fallback = user_cache_folder() == "/home/someone/.cache/orthonav";
        unsetenv("XDG_CACHE_HOME");
        unsetenv("HOME");
        std::_Exit(given && fallback && user_cache_folder().empty() ? 0 : 1);
      },
      ::testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace orthonav::render
