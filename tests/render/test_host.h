#pragma once

#include <memory>
#include <string>
#include <vector>

#include "render/renderer.h"
#include "tests/support/image_chain.h"

namespace orthonav::render {

/// A host that creates the requested objects on the software rasterizer.
class TestHost : public VulkanHost {
 public:
  std::array<VulkanVersion, 2> allowed = {VulkanVersion{1, 0}, VulkanVersion{1, 3}};
  /// If set, answers with this instead of making a device.
  std::string refusal;

  [[nodiscard]] std::array<VulkanVersion, 2> versions() const override { return allowed; }
  Result<void*> create_instance(VulkanFunction get, const void* info) override;
  Result<void*> physical_device(void* instance) override;
  Result<void*> create_device(void* physical, VulkanFunction get, const void* info) override;
  /// The version that the renderer requested for the instance.
  std::uint32_t asked_version = 0;
};

/// Images for both eyes, as a runtime would hand them out, which are read back one by one.
class TestImages {
 public:
  TestImages(const VulkanObjects& objects, VkFormat format, int width_px, int height_px,
             std::uint32_t layers);
  [[nodiscard]] const EyeImages& targets() const { return targets_; }
  /// The pixels of an eye in image `image` of its chain.
  [[nodiscard]] std::vector<std::uint8_t> read(std::size_t eye, std::size_t image);

 private:
  EyeImages targets_;
  std::vector<std::unique_ptr<test::ImageChain>> chains_;
};

}  // namespace orthonav::render
