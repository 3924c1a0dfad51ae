#include "render/renderer.h"

#include <exception>

#include "render/vulkan/vulkan_renderer.h"

namespace orthonav::render {

std::unique_ptr<Renderer> Renderer::create(const RendererOptions& options, std::string& error) {
  try {
    return std::make_unique<VulkanRenderer>(options);
  } catch (const std::exception& failure) {
    error = failure.what();
    return nullptr;
  }
}

std::vector<DeviceInfo> list_devices() {
  std::vector<DeviceInfo> devices;
  try {
    const Instance instance(false);
    for (const VkPhysicalDevice physical : instance.devices()) {
      devices.push_back(describe(physical));
    }
  } catch (const std::exception&) {
    devices.clear();  // no Vulkan, no devices
  }
  return devices;
}

}  // namespace orthonav::render
