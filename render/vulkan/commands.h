#pragma once

#include <chrono>
#include <span>

#include "render/pixel_rect.h"
#include "render/vulkan/device.h"
#include "render/vulkan/handle.h"
#include "render/vulkan/memory.h"

namespace orthonav::render {

/// Records and runs commands, one batch at a time.
class Commands {
 public:
  explicit Commands(const Device& device,
                    std::chrono::nanoseconds patience = std::chrono::seconds(10));
  /// Starts a new batch and drops anything recorded before.
  VkCommandBuffer begin();
  /// Submits the batch and waits for its end.
  void run();
  /// Submits the batch; `wait` before the next `begin`.
  void submit();
  /// Waits until the submitted batch has ended; returns at once if there is none. If that fails or
  /// takes longer than `patience`, it throws that the device is lost, but not before the device is
  /// idle, so that the caller may destroy what the batch used.
  void wait();
  /// Milliseconds that submitting the last batch took.
  [[nodiscard]] double submit_ms() const { return submit_ms_; }

 private:
  VkDevice device_ = VK_NULL_HANDLE;
  VkQueue queue_ = VK_NULL_HANDLE;
  CommandPool pool_;
  VkCommandBuffer buffer_ = VK_NULL_HANDLE;
  Fence finished_;
  std::chrono::nanoseconds patience_;
  double submit_ms_ = 0;
  bool underway_ = false;
};

struct LayoutChange {
  VkImage image = VK_NULL_HANDLE;
  std::uint32_t layers = 1;
  VkImageLayout from = VK_IMAGE_LAYOUT_UNDEFINED;
  VkImageLayout to = VK_IMAGE_LAYOUT_UNDEFINED;
};
/// A barrier between the transfers before it and the shaders or transfers after it.
void change_layout(VkCommandBuffer commands, const LayoutChange& change);

/// An image with layers, to be filled from a buffer that holds all of them one after the other.
struct ImageFill {
  const Buffer& from;
  const DeviceImage& to;
  VkExtent2D extent;
  std::size_t texel_bytes = 4;
  std::uint32_t filled_layers = 1;
  std::uint32_t layers = 1;
  VkDeviceSize offset = 0;  ///< where the first layer begins in the buffer
};
/// Fills some regions, leaves the rest undefined, and readies the image for shaders.
void fill_image(VkCommandBuffer commands, const ImageFill& fill,
                std::span<const PixelRect> regions);

}  // namespace orthonav::render
