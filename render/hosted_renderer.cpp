#include "render/hosted_renderer.h"

#include <exception>

#include "render/vulkan/hosted_vulkan_renderer.h"

namespace orthonav::render {

std::unique_ptr<HostedRenderer> HostedRenderer::create(const RendererOptions& options,
                                                       VulkanHost& host, std::string& error) {
  try {
    return std::make_unique<HostedVulkanRenderer>(options, host);
  } catch (const std::exception& failure) {
    error = failure.what();
    return nullptr;
  }
}

}  // namespace orthonav::render
