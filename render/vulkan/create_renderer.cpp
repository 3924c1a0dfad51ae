#include "render/renderer.h"

#include <exception>

#include "render/frame/scene_check.h"
#include "render/vulkan/failure.h"
#include "render/vulkan/vulkan_renderer.h"

namespace orthonav::render {

Result<std::unique_ptr<Renderer>> Renderer::create(const RendererOptions& options) {
  if (const Status checked = check_options(options); !checked) {
    return checked.error();
  }
  try {
    std::unique_ptr<Renderer> renderer = std::make_unique<VulkanRenderer>(options);
    return renderer;
  } catch (const std::exception&) {
    return error_in_flight();
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
