#include "render/hosted_renderer.h"

#include <exception>

#include "render/vulkan/failure.h"
#include "render/vulkan/hosted_vulkan_renderer.h"

namespace orthonav::render {

Result<std::unique_ptr<HostedRenderer>> HostedRenderer::create(const RendererOptions& options,
                                                               VulkanHost& host) {
  try {
    std::unique_ptr<HostedRenderer> renderer =
        std::make_unique<HostedVulkanRenderer>(options, host);
    return renderer;
  } catch (const std::exception&) {
    return error_in_flight();
  }
}

}  // namespace orthonav::render
