#include "render/renderer.h"

#include <exception>
#include <utility>

#include "render/frame/scene_check.h"
#include "render/vulkan/eye_pair_renderer.h"
#include "render/vulkan/failure.h"
#include "render/vulkan/vulkan_renderer.h"

namespace orthonav::render {

namespace {

/// Where the device is the processor, each eye has one of its own, unless told otherwise.
std::unique_ptr<Renderer> fitting_renderer(RendererOptions options) {
  if (!options.messages) {
    options.messages = std::make_shared<std::vector<std::string>>();
  }
  auto renderer = std::make_unique<VulkanRenderer>(options);
  if (options.eyes_a_pass != EyesAPass::kProbe || renderer->device().type != "CPU") {
    return renderer;
  }
  return std::make_unique<EyePairRenderer>(options, std::move(renderer));
}

}  // namespace

Result<std::unique_ptr<Renderer>> Renderer::create(const RendererOptions& options) {
  if (const Status checked = check_options(options); !checked) {
    return checked.error();
  }
  try {
    return fitting_renderer(options);
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
