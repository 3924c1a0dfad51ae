#include <gmock/gmock.h>
#include <gtest/gtest-spi.h>

#include <limits>

#include "render/vulkan/commands.h"
#include "render/vulkan/failure.h"
#include "tests/render/silent_validation.h"
#include "tests/render/test_renderer.h"
#include "tests/support/test_device.h"

namespace orthonav::render {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// Anisotropy without its feature: wrong, but harmless to the driver.
void ask_for_what_was_not_enabled(const Device& device) {
  VkSamplerCreateInfo info = {};
  info.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO;
  info.anisotropyEnable = VK_TRUE;
  info.maxAnisotropy = 1;
  VkSampler sampler = VK_NULL_HANDLE;
  check(vkCreateSampler(device.get(), &info, nullptr, &sampler), "sampler");
  vkDestroySampler(device.get(), sampler, nullptr);
}

void leave_a_fence_behind(const Device& device) {
  VkFenceCreateInfo info = {};
  info.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
  VkFence fence = VK_NULL_HANDLE;
  check(vkCreateFence(device.get(), &info, nullptr, &fence), "fence");
}

TEST(Validation, HearsAnInvalidCall) {
  const auto messages = std::make_shared<std::vector<std::string>>();
  const Instance instance(true, messages);
  const Device device(choose_device(instance, test::test_device()).value());
  EXPECT_THAT(*messages, IsEmpty());
  ask_for_what_was_not_enabled(device);
  EXPECT_THAT(*messages, Contains(HasSubstr("anisotropyEnable")));
  EXPECT_EQ(*messages, instance.messages());
}

TEST(Validation, HearsABadPractice) {
  const auto messages = std::make_shared<std::vector<std::string>>();
  const Instance instance(true, messages);
  const Device device(choose_device(instance, test::test_device()).value());
  // A pool that may be reset by halves costs more; nothing is wrong with it otherwise.
  VkCommandPoolCreateInfo info = {};
  info.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
  info.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
  info.queueFamilyIndex = device.queue_family();
  VkCommandPool pool = VK_NULL_HANDLE;
  check(vkCreateCommandPool(device.get(), &info, nullptr, &pool), "command pool");
  vkDestroyCommandPool(device.get(), pool, nullptr);
  EXPECT_THAT(*messages, Contains(HasSubstr("BestPractices")));
}

TEST(Validation, FailsATestForWhatIsLeftBehind) {
  EXPECT_NONFATAL_FAILURE(
      {
        const SilentValidation validation;
        const Instance instance(true, validation.sink());
        const Device device(choose_device(instance, test::test_device()).value());
        leave_a_fence_behind(device);
      },
      "has not been destroyed");
}

TEST(Validation, HearsTheRenderersOwnMessagesAfterItIsGone) {
  const auto messages = std::make_shared<std::vector<std::string>>();
  RendererOptions options;
  options.width_px = options.height_px = 64;
  options.device = test::test_device();
  options.cache_folder = "";
  options.validation = true;
  options.messages = messages;
  auto renderer = Renderer::create(options);
  ASSERT_TRUE(test::is_ok(renderer));
  EXPECT_EQ(&(*renderer)->validation_messages(), messages.get());
  renderer->reset();
  EXPECT_THAT(*messages, IsEmpty());
}

TEST(Size, BeyondTheDeviceIsOneLine) {
  VkPhysicalDeviceLimits limits = {};
  limits.maxImageDimension2D = 4096;
  limits.maxFramebufferWidth = 2048;
  limits.maxFramebufferHeight = 8192;
  EXPECT_TRUE(check_size(limits, 2048, 4096).ok());
  EXPECT_EQ(test::error_of(check_size(limits, 2049, 64)),
            "renderer: image of 2049x64 px, limit of the device 2048x4096 px");
  EXPECT_EQ(test::error_of(check_size(limits, 64, 4097)),
            "renderer: image of 64x4097 px, limit of the device 2048x4096 px");
}

/// A batch that takes the device a while.
class LongBatch : public ::testing::Test {
 protected:
  static constexpr VkDeviceSize kBytes = 64u << 20u;
  static constexpr std::uint32_t kValue = 0x01020304;

  void record(Commands& commands, const Buffer& buffer) {
    const VkCommandBuffer batch = commands.begin();
    for (int i = 0; i < 8; ++i) {
      vkCmdFillBuffer(batch, buffer.get(), 0, VK_WHOLE_SIZE, kValue + static_cast<unsigned>(i));
      VkMemoryBarrier barrier = {};
      barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
      barrier.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
      barrier.dstAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT | VK_ACCESS_HOST_READ_BIT;
      vkCmdPipelineBarrier(batch, VK_PIPELINE_STAGE_TRANSFER_BIT,
                           VK_PIPELINE_STAGE_TRANSFER_BIT | VK_PIPELINE_STAGE_HOST_BIT, 0, 1,
                           &barrier, 0, nullptr, 0, nullptr);
    }
  }
  SilentValidation validation_;
  Instance instance_{true, validation_.sink()};
  Device device_{choose_device(instance_, test::test_device()).value()};
};

TEST_F(LongBatch, IsLostWhenItOutlastsThePatienceAndOverWhenThatIsTold) {
  Commands commands(device_, std::chrono::nanoseconds(0));
  const Buffer buffer(device_, kBytes, VK_BUFFER_USAGE_TRANSFER_DST_BIT, BufferPlace::kReadback);
  record(commands, buffer);
  try {
    commands.run();
    ADD_FAILURE() << "not lost";
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.error().code, ErrorCode::kLost);
  }
  EXPECT_EQ(reinterpret_cast<const std::uint32_t*>(buffer.mapped())[kBytes / 4 - 1], kValue + 7);
}

TEST_F(LongBatch, IsNotLostWithPatience) {
  Commands commands(device_);
  const Buffer buffer(device_, kBytes, VK_BUFFER_USAGE_TRANSFER_DST_BIT, BufferPlace::kReadback);
  record(commands, buffer);
  EXPECT_NO_THROW(commands.run());
}

}  // namespace
}  // namespace orthonav::render
