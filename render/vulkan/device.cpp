#include "render/vulkan/device.h"

#include <algorithm>
#include <cctype>
#include <optional>

#include "render/vulkan/failure.h"

namespace orthonav::render {
namespace {

std::optional<std::uint32_t> graphics_family(VkPhysicalDevice physical) {
  std::uint32_t count = 0;
  vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, families.data());
  for (std::uint32_t i = 0; i < count; ++i) {
    if (families[i].queueFlags & VK_QUEUE_GRAPHICS_BIT) {
      return i;
    }
  }
  return std::nullopt;
}

bool offers(VkPhysicalDevice physical, VkFormat format, VkFormatFeatureFlags features) {
  VkFormatProperties properties;
  vkGetPhysicalDeviceFormatProperties(physical, format, &properties);
  return (properties.optimalTilingFeatures & features) == features;
}

VkFormat depth_format_of(VkPhysicalDevice physical) {
  // 24 bits resolve a micrometre at arm's length and cost half as much as 32 + 8.
  for (const VkFormat format : {VK_FORMAT_D24_UNORM_S8_UINT, VK_FORMAT_D32_SFLOAT_S8_UINT}) {
    if (offers(physical, format, VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT)) {
      return format;
    }
  }
  return VK_FORMAT_UNDEFINED;
}

std::string type_name(VkPhysicalDeviceType type) {
  switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
      return "discrete GPU";
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
      return "integrated GPU";
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
      return "virtual GPU";
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
      return "CPU";
    default:
      return "other";
  }
}

int rank(const std::string& type) {
  if (type == "discrete GPU") {
    return 4;
  }
  if (type == "integrated GPU") {
    return 3;
  }
  if (type == "virtual GPU") {
    return 2;
  }
  return type == "CPU" ? 1 : 0;
}

std::string version_text(std::uint32_t version) {
  std::string text = std::to_string(VK_API_VERSION_MAJOR(version));
  text += '.';
  text += std::to_string(VK_API_VERSION_MINOR(version));
  return text;
}

/// Why the device is not suitable; empty when it is.
std::string shortcoming(VkPhysicalDevice physical, const VkPhysicalDeviceProperties& properties) {
  if (properties.apiVersion < VK_API_VERSION_1_1) {
    return "Vulkan " + version_text(properties.apiVersion) + ", needs 1.1";
  }
  VkPhysicalDeviceMultiviewFeatures multiview = {};
  multiview.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MULTIVIEW_FEATURES;
  VkPhysicalDeviceFeatures2 features = {};
  features.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
  features.pNext = &multiview;
  vkGetPhysicalDeviceFeatures2(physical, &features);
  if (multiview.multiview != VK_TRUE) {
    return "no multiview";
  }
  if (!graphics_family(physical)) {
    return "no graphics queue";
  }
  if (!offers(physical, kColourFormat,
              VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT | VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT)) {
    return "no blending into sRGB images";
  }
  if (!offers(physical, kLabelFormat, VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT)) {
    return "no 32-bit integer images";
  }
  if (depth_format_of(physical) == VK_FORMAT_UNDEFINED) {
    return "no depth with stencil";
  }
  const VkSampleCountFlags samples = properties.limits.framebufferColorSampleCounts &
                                     properties.limits.framebufferDepthSampleCounts &
                                     properties.limits.framebufferStencilSampleCounts;
  return samples & VK_SAMPLE_COUNT_4_BIT ? "" : "no four samples a pixel";
}

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

}  // namespace

DeviceInfo describe(VkPhysicalDevice physical) {
  VkPhysicalDeviceDriverProperties driver = {};
  driver.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES;
  VkPhysicalDeviceProperties2 properties = {};
  properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
  VkPhysicalDeviceProperties basic;
  vkGetPhysicalDeviceProperties(physical, &basic);
  // The driver's own name came with Vulkan 1.2; before that there is only a number.
  if (basic.apiVersion >= VK_API_VERSION_1_2) {
    properties.pNext = &driver;
  }
  if (basic.apiVersion >= VK_API_VERSION_1_1) {
    vkGetPhysicalDeviceProperties2(physical, &properties);
  }
  DeviceInfo info;
  info.name = basic.deviceName;
  info.driver = driver.driverName[0] != '\0'
                    ? std::string(driver.driverName) + " " + driver.driverInfo
                    : "version " + std::to_string(basic.driverVersion);
  info.type = type_name(basic.deviceType);
  info.reason = shortcoming(physical, basic);
  info.usable = info.reason.empty();
  return info;
}

Result<VkPhysicalDevice> choose_device(const Instance& instance, const std::string& wanted) {
  VkPhysicalDevice best = VK_NULL_HANDLE;
  int best_rank = -1;
  std::string seen;
  for (const VkPhysicalDevice physical : instance.devices()) {
    const DeviceInfo info = describe(physical);
    seen += (seen.empty() ? "" : ", ") + info.name + (info.usable ? "" : " (" + info.reason + ")");
    const bool named = lower(info.name).find(lower(wanted)) != std::string::npos;
    if (!info.usable || !named || rank(info.type) <= best_rank) {
      continue;
    }
    best = physical;
    best_rank = rank(info.type);
  }
  if (best != VK_NULL_HANDLE) {
    return best;
  }
  if (seen.empty()) {
    return Error{"renderer: no Vulkan device on this machine", ErrorCode::kNotFound};
  }
  return Error{"renderer: no usable Vulkan device" +
                   (wanted.empty() ? "" : " named '" + wanted + "'") + "; there is: " + seen,
               ErrorCode::kNotFound};
}

Result<VkPhysicalDevice> device_of(VulkanHost& host, const Instance& instance) {
  const Result<void*> answer = handle_of(host.physical_device(instance.get()));
  if (!answer) {
    return answer.error();
  }
  auto* physical = static_cast<VkPhysicalDevice>(*answer);
  const DeviceInfo info = describe(physical);
  if (!info.usable) {
    return Error{"renderer: " + info.name + ": " + info.reason};
  }
  return physical;
}

Status check_size(const VkPhysicalDeviceLimits& limits, int width_px, int height_px) {
  const std::uint32_t most_across =
      std::min(limits.maxImageDimension2D, limits.maxFramebufferWidth);
  const std::uint32_t most_down = std::min(limits.maxImageDimension2D, limits.maxFramebufferHeight);
  if (static_cast<std::uint32_t>(width_px) <= most_across &&
      static_cast<std::uint32_t>(height_px) <= most_down) {
    return {};
  }
  return Error{"renderer: image of " + std::to_string(width_px) + "x" + std::to_string(height_px) +
               " px, limit of the device " + std::to_string(most_across) + "x" +
               std::to_string(most_down) + " px"};
}

Device::Device(VkPhysicalDevice physical, VulkanHost* host) {
  queue_family_ = graphics_family(physical).value();
  depth_format_ = depth_format_of(physical);
  vkGetPhysicalDeviceMemoryProperties(physical, &memory_);
  const float priority = 1;
  VkDeviceQueueCreateInfo queue = {};
  queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
  queue.queueFamilyIndex = queue_family_;
  queue.queueCount = 1;
  queue.pQueuePriorities = &priority;
  VkPhysicalDeviceMultiviewFeatures multiview = {};
  multiview.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MULTIVIEW_FEATURES;
  multiview.multiview = VK_TRUE;
  VkDeviceCreateInfo info = {};
  info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
  info.pNext = &multiview;
  info.queueCreateInfoCount = 1;
  info.pQueueCreateInfos = &queue;
  if (host != nullptr) {
    const auto get = reinterpret_cast<VulkanFunction>(vkGetInstanceProcAddr);
    device_ = static_cast<VkDevice>(value_of(handle_of(host->create_device(physical, get, &info))));
  } else {
    check(vkCreateDevice(physical, &info, nullptr, &device_), "Vulkan device");
  }
  vkGetDeviceQueue(device_, queue_family_, 0, &queue_);
}

Device::~Device() {
  vkDeviceWaitIdle(device_);
  vkDestroyDevice(device_, nullptr);
}

std::uint32_t Device::memory_type(std::uint32_t allowed, VkMemoryPropertyFlags required,
                                  VkMemoryPropertyFlags preferred) const {
  for (const VkMemoryPropertyFlags flags : {required | preferred, required}) {
    for (std::uint32_t i = 0; i < memory_.memoryTypeCount; ++i) {
      const bool fits = (memory_.memoryTypes[i].propertyFlags & flags) == flags;
      if ((allowed >> i & 1u) != 0 && fits) {
        return i;
      }
    }
  }
  throw Failure(VK_ERROR_OUT_OF_DEVICE_MEMORY, "memory of the wanted kind");
}

}  // namespace orthonav::render
