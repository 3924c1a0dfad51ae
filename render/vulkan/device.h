#pragma once

#include <vulkan/vulkan.h>

#include <string>
#include <vector>

#include "base/result.h"
#include "render/renderer.h"
#include "render/vulkan/instance.h"

namespace orthonav::render {

inline constexpr VkFormat kColourFormat = VK_FORMAT_R8G8B8A8_SRGB;
inline constexpr VkFormat kLabelFormat = VK_FORMAT_R32_UINT;

/// What a physical device offers and, if it is not suitable, why.
[[nodiscard]] DeviceInfo describe(VkPhysicalDevice physical);

/// The device to draw with: the best usable one whose name contains `wanted` (case ignored);
/// discrete before integrated before virtual before CPU.
[[nodiscard]] Result<VkPhysicalDevice> choose_device(const Instance& instance,
                                                     const std::string& wanted);

/// The device that the host wants.
[[nodiscard]] Result<VkPhysicalDevice> device_of(VulkanHost& host, const Instance& instance);

/// Whether the device can hold one eye's image.
[[nodiscard]] Status check_size(const VkPhysicalDeviceLimits& limits, int width_px, int height_px);

/// A logical device with one graphics queue.
class Device {
 public:
  /// With a host, the host makes it. Throws Failure.
  explicit Device(VkPhysicalDevice physical, VulkanHost* host = nullptr);
  ~Device();
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  [[nodiscard]] VkDevice get() const { return device_; }
  [[nodiscard]] VkQueue queue() const { return queue_; }
  [[nodiscard]] std::uint32_t queue_family() const { return queue_family_; }
  [[nodiscard]] VkFormat depth_format() const { return depth_format_; }
  /// A memory type among `allowed` with all `required` flags, and with the `preferred` ones if
  /// possible.
  [[nodiscard]] std::uint32_t memory_type(std::uint32_t allowed, VkMemoryPropertyFlags required,
                                          VkMemoryPropertyFlags preferred) const;

 private:
  VkDevice device_ = VK_NULL_HANDLE;
  VkQueue queue_ = VK_NULL_HANDLE;
  std::uint32_t queue_family_ = 0;
  VkFormat depth_format_ = VK_FORMAT_UNDEFINED;
  VkPhysicalDeviceMemoryProperties memory_{};
};

}  // namespace orthonav::render
