#pragma once

#include <vulkan/vulkan.h>

#include <string>
#include <vector>

#include "render/hosted_renderer.h"

namespace orthonav::render {

/// A host that makes what it is asked for, on the software rasterizer.
class TestHost : public VulkanHost {
 public:
  std::array<VulkanVersion, 2> allowed = {VulkanVersion{1, 0}, VulkanVersion{1, 3}};
  /// Answers so instead of making a device.
  std::string refusal;

  [[nodiscard]] std::array<VulkanVersion, 2> versions() const override { return allowed; }
  void* create_instance(VulkanFunction get, const void* info, std::string& error) override;
  void* physical_device(void* instance, std::string& error) override;
  void* create_device(void* physical, VulkanFunction get, const void* info,
                      std::string& error) override;
  /// What the renderer asked the instance to be of.
  std::uint32_t asked_version = 0;
};

/// Chains of images of two each, as a runtime would hand them out, which are read back one by one.
class TestImages {
 public:
  TestImages(const VulkanObjects& objects, VkFormat format, int width_px, int height_px,
             std::uint32_t layers);
  ~TestImages();
  TestImages(const TestImages&) = delete;
  TestImages& operator=(const TestImages&) = delete;

  [[nodiscard]] const EyeTargets& targets() const { return targets_; }
  /// The bytes of one layer, which must be in VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL and stays
  /// so.
  [[nodiscard]] std::vector<std::uint8_t> read(std::uint64_t image, std::uint32_t layer,
                                               int pixel_bytes = 4);

 private:
  void make_readback();
  [[nodiscard]] std::uint32_t memory_type(std::uint32_t allowed, VkMemoryPropertyFlags flags) const;
  void copy_layer(VkCommandBuffer commands, VkImage image, std::uint32_t layer);

  VulkanObjects objects_;
  VkDevice device_;
  VkQueue queue_ = VK_NULL_HANDLE;
  EyeTargets targets_;
  std::vector<VkDeviceMemory> memory_;
  VkBuffer buffer_ = VK_NULL_HANDLE;
  VkCommandPool pool_ = VK_NULL_HANDLE;
  std::uint8_t* mapped_ = nullptr;
};

}  // namespace orthonav::render
