#pragma once

#include <chrono>

#include "render/vulkan/device.h"
#include "render/vulkan/handle.h"
#include "render/vulkan/memory.h"

namespace orthonav::render {

/// Records and runs commands, one batch at a time, each to its end.
class Commands {
 public:
  explicit Commands(const Device& device,
                    std::chrono::nanoseconds patience = std::chrono::seconds(10));
  /// Starts a new batch; what was recorded before is forgotten.
  VkCommandBuffer begin();
  /// Runs the batch and waits for it. Throws on a lost device or one that takes longer than the
  /// patience; not before the device is idle, so that the caller may destroy what the batch used.
  void run();
  /// Whether a batch that was handed over did not come back in order: draw no more with the device.
  [[nodiscard]] bool lost() const { return lost_; }

 private:
  VkDevice device_ = VK_NULL_HANDLE;
  VkQueue queue_ = VK_NULL_HANDLE;
  CommandPool pool_;
  VkCommandBuffer buffer_ = VK_NULL_HANDLE;
  Fence finished_;
  std::chrono::nanoseconds patience_;
  bool lost_ = false;
};

struct LayoutChange {
  VkImage image = VK_NULL_HANDLE;
  std::uint32_t layers = 1;
  VkImageLayout from = VK_IMAGE_LAYOUT_UNDEFINED;
  VkImageLayout to = VK_IMAGE_LAYOUT_UNDEFINED;
};
/// A barrier between the transfers before it and the shaders or transfers after it.
void change_layout(VkCommandBuffer commands, const LayoutChange& change);

/// Fills layers of an image from a buffer, one layer after the other, and readies it for shaders.
void fill_image(VkCommandBuffer commands, const Buffer& from, const DeviceImage& to,
                VkExtent2D extent, std::uint32_t filled_layers, std::uint32_t layers);

}  // namespace orthonav::render
