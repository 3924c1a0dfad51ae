#include "render/vulkan/handle.h"

namespace orthonav::render {
namespace {

std::string name_of(VkResult result) {
  switch (result) {
    case VK_ERROR_OUT_OF_HOST_MEMORY:
      return "out of host memory";
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
      return "out of device memory";
    case VK_ERROR_DEVICE_LOST:
      return "device lost";
    case VK_ERROR_INITIALIZATION_FAILED:
      return "initialization failed";
    case VK_ERROR_LAYER_NOT_PRESENT:
      return "layer not installed";
    case VK_ERROR_EXTENSION_NOT_PRESENT:
      return "extension not present";
    case VK_ERROR_FEATURE_NOT_PRESENT:
      return "feature not present";
    case VK_ERROR_INCOMPATIBLE_DRIVER:
      return "no Vulkan driver";
    case VK_ERROR_TOO_MANY_OBJECTS:
      return "too many objects";
    case VK_ERROR_FORMAT_NOT_SUPPORTED:
      return "format not supported";
    case VK_TIMEOUT:
      return "not finished in time";
    default:
      return "VkResult " + std::to_string(static_cast<int>(result));
  }
}

}  // namespace

VulkanFailure::VulkanFailure(VkResult result, const std::string& what)
    : std::runtime_error("renderer: " + what + ": " + name_of(result)), result_(result) {}

void check(VkResult result, const char* what) {
  if (result != VK_SUCCESS) {
    throw VulkanFailure(result, what);
  }
}

}  // namespace orthonav::render
