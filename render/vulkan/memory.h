#pragma once

#include <cstddef>

#include "render/vulkan/device.h"
#include "render/vulkan/handle.h"

namespace orthonav::render {

enum class BufferPlace {
  kUpload,    ///< written by the CPU every frame, read by the GPU
  kReadback,  ///< written by the GPU, read by the CPU
  kDevice     ///< filled once through an upload buffer
};

/// A buffer with memory of its own; mapped for its whole life unless kDevice.
class Buffer {
 public:
  Buffer() = default;
  Buffer(const Device& device, VkDeviceSize size, VkBufferUsageFlags usage, BufferPlace place);
  [[nodiscard]] VkBuffer get() const { return buffer_.get(); }
  [[nodiscard]] VkDeviceSize size() const { return size_; }
  [[nodiscard]] std::byte* mapped() const { return mapped_; }
  void write(const void* bytes, std::size_t count, std::size_t offset = 0) const;

 private:
  DeviceMemory memory_;  // outlives the buffer bound to it
  BufferHandle buffer_;
  VkDeviceSize size_ = 0;
  std::byte* mapped_ = nullptr;
};

struct ImageSpec {
  VkFormat format = VK_FORMAT_UNDEFINED;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint32_t layers = 1;
  VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
  VkImageUsageFlags usage = 0;
  VkImageAspectFlags aspect = VK_IMAGE_ASPECT_COLOR_BIT;
  VkImageViewType view = VK_IMAGE_VIEW_TYPE_2D_ARRAY;
};

/// An image on the device with memory and a view of all its layers.
class DeviceImage {
 public:
  DeviceImage() = default;
  DeviceImage(const Device& device, const ImageSpec& spec);
  [[nodiscard]] VkImage get() const { return image_.get(); }
  [[nodiscard]] VkImageView view() const { return view_.get(); }

 private:
  DeviceMemory memory_;
  ImageHandle image_;
  ImageView view_;
};

}  // namespace orthonav::render
