#include <array>
#include <cstring>

#include "tests/support/openxr_runtime/double_state.h"

// XR_KHR_vulkan_enable2: the Vulkan instance and device that images are made on.

namespace orthonav::test {
namespace {

XrResult XRAPI_CALL requirements(XrInstance, XrSystemId, XrGraphicsRequirementsVulkanKHR* needs) {
  Double& d = the_double();
  const std::lock_guard lock(d.mutex);
  if (d.instance_lost) {
    return XR_ERROR_INSTANCE_LOST;
  }
  d.requirements_asked = true;
  needs->minApiVersionSupported = d.traits.least_vulkan;
  needs->maxApiVersionSupported = d.traits.most_vulkan;
  return XR_SUCCESS;
}

XrResult XRAPI_CALL create_vulkan_instance(XrInstance, const XrVulkanInstanceCreateInfoKHR* info,
                                           VkInstance* instance, VkResult* result) {
  Double& d = the_double();
  const std::lock_guard lock(d.mutex);
  if (!d.requirements_asked) {
    return d.violated("a Vulkan instance before its requirements",
                      XR_ERROR_GRAPHICS_REQUIREMENTS_CALL_MISSING);
  }
  const auto create = reinterpret_cast<PFN_vkCreateInstance>(
      info->pfnGetInstanceProcAddr(VK_NULL_HANDLE, "vkCreateInstance"));
  *result = create(info->vulkanCreateInfo, info->vulkanAllocator, instance);
  d.vk_instance = *instance;
  return XR_SUCCESS;
}

XrResult XRAPI_CALL graphics_device(XrInstance, const XrVulkanGraphicsDeviceGetInfoKHR* info,
                                    VkPhysicalDevice* physical) {
  Double& d = the_double();
  const std::lock_guard lock(d.mutex);
  if (info->vulkanInstance != d.vk_instance) {
    return d.violated("a device of another Vulkan instance", XR_ERROR_VALIDATION_FAILURE);
  }
  std::uint32_t count = 8;
  std::array<VkPhysicalDevice, 8> devices = {};
  vkEnumeratePhysicalDevices(d.vk_instance, &count, devices.data());
  for (std::uint32_t i = 0; i < count; ++i) {
    VkPhysicalDeviceProperties properties;
    vkGetPhysicalDeviceProperties(devices[i], &properties);
    if (std::strstr(properties.deviceName, "llvmpipe") != nullptr) {
      *physical = devices[i];
    }
  }
  d.vk_physical = *physical;
  return *physical == VK_NULL_HANDLE ? XR_ERROR_RUNTIME_FAILURE : XR_SUCCESS;
}

XrResult XRAPI_CALL create_vulkan_device(XrInstance, const XrVulkanDeviceCreateInfoKHR* info,
                                         VkDevice* device, VkResult* result) {
  Double& d = the_double();
  const std::lock_guard lock(d.mutex);
  if (info->vulkanPhysicalDevice != d.vk_physical) {
    return d.violated("a device other than the one that was named", XR_ERROR_VALIDATION_FAILURE);
  }
  const auto create = reinterpret_cast<PFN_vkCreateDevice>(
      info->pfnGetInstanceProcAddr(d.vk_instance, "vkCreateDevice"));
  *result =
      create(info->vulkanPhysicalDevice, info->vulkanCreateInfo, info->vulkanAllocator, device);
  d.vk_device = *device;
  return XR_SUCCESS;
}

}  // namespace

void add_vulkan_functions(std::map<std::string, PFN_xrVoidFunction>& table) {
  table["xrGetVulkanGraphicsRequirements2KHR"] = as_void(requirements);
  table["xrCreateVulkanInstanceKHR"] = as_void(create_vulkan_instance);
  table["xrGetVulkanGraphicsDevice2KHR"] = as_void(graphics_device);
  table["xrCreateVulkanDeviceKHR"] = as_void(create_vulkan_device);
}

}  // namespace orthonav::test
