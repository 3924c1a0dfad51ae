#pragma once

#include <array>

#include "render/vulkan/memory.h"

namespace orthonav::render {

enum class PassKind { kColour, kLabels };

struct TargetSpec {
  PassKind kind = PassKind::kColour;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint32_t views = 1;
  VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;  ///< labels have one, whatever is asked
};

/// The images of one kind of frame, one layer a view, and the pass that draws into all layers at
/// once. The result is left ready to be copied from.
class Targets {
 public:
  Targets(const Device& device, const TargetSpec& spec);
  [[nodiscard]] const TargetSpec& spec() const { return spec_; }
  [[nodiscard]] VkRenderPass pass() const { return pass_.get(); }
  [[nodiscard]] VkFramebuffer framebuffer() const { return framebuffer_.get(); }
  /// The single-sample image to read.
  [[nodiscard]] VkImage result() const { return resolves() ? result_.get() : colour_.get(); }
  [[nodiscard]] bool resolves() const { return spec_.samples != VK_SAMPLE_COUNT_1_BIT; }

 private:
  [[nodiscard]] std::array<VkAttachmentDescription, 3> attachments(VkFormat colour,
                                                                   VkFormat depth) const;
  void make_pass(const Device& device, VkFormat format);
  void make_framebuffer(const Device& device);

  TargetSpec spec_;
  DeviceImage colour_;
  DeviceImage depth_;
  DeviceImage result_;  ///< of the resolve; empty with one sample
  RenderPass pass_;
  Framebuffer framebuffer_;
};

}  // namespace orthonav::render
