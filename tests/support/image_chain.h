#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <vector>

#include "base/vulkan_handover.h"

namespace orthonav::test {

/// A ring of images on another owner's device, as a runtime hands them out, which are read back one
/// by one. Aborts when Vulkan fails, because it is also used outside tests.
class ImageChain {
 public:
  ImageChain(const VulkanObjects& objects, VkFormat format, int width_px, int height_px,
             std::uint32_t layers, std::size_t count = 2,
             VkImageAspectFlags aspect = VK_IMAGE_ASPECT_COLOR_BIT);
  ~ImageChain();
  ImageChain(const ImageChain&) = delete;
  ImageChain& operator=(const ImageChain&) = delete;

  [[nodiscard]] const std::vector<VkImage>& images() const { return images_; }
  [[nodiscard]] std::vector<std::uint64_t> handles() const;
  /// The bytes of one layer, which must be an attachment of colour or of depth, and stays so.
  [[nodiscard]] std::vector<std::uint8_t> read(std::size_t image, std::uint32_t layer,
                                               int pixel_bytes = 4);

 private:
  void add_image(VkFormat format);
  void make_readback();
  void copy_layer(VkCommandBuffer commands, VkImage image, std::uint32_t layer);
  VkDeviceMemory memory_for(const VkMemoryRequirements& needs, VkMemoryPropertyFlags flags);

  VulkanObjects objects_;
  VkDevice device_;
  VkQueue queue_ = VK_NULL_HANDLE;
  int width_px_;
  int height_px_;
  std::uint32_t layers_;
  VkImageAspectFlags aspect_;
  std::vector<VkImage> images_;
  std::vector<VkDeviceMemory> memory_;
  VkBuffer buffer_ = VK_NULL_HANDLE;
  VkCommandPool pool_ = VK_NULL_HANDLE;
  std::uint8_t* mapped_ = nullptr;
};

}  // namespace orthonav::test
