#pragma once

#include <array>
#include <vector>

#include "render/vulkan/memory.h"

namespace orthonav::render {

enum class PassKind {
  kColour,
  kLabels,
  kDepth  ///< of everything that shows, for somebody else to know how far it is
};

struct TargetSpec {
  PassKind kind = PassKind::kColour;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint32_t views = 1;
  VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;  ///< one but for colour, whatever is asked
  VkFormat colour = kColourFormat;
  VkFormat depth = VK_FORMAT_UNDEFINED;  ///< of the outer images, where depth alone is drawn
  /// Someone else's images with as many layers as there are views, one of which receives the result
  /// at a time; empty: the targets have an image of their own.
  std::vector<VkImage> outer;
};

/// The images of one kind of frame, one layer a view, and the pass that draws into all layers at
/// once. The result is left ready to be copied from, or in somebody else's image as an attachment.
class Targets {
 public:
  Targets(const Device& device, const TargetSpec& spec);
  [[nodiscard]] const TargetSpec& spec() const { return spec_; }
  [[nodiscard]] VkRenderPass pass() const { return pass_.get(); }
  /// `outer`: an index into the outer images, where there are some.
  [[nodiscard]] VkFramebuffer framebuffer(std::size_t outer = 0) const {
    return framebuffers_[outer].get();
  }
  /// The single-sample image to read, where it is the targets' own.
  [[nodiscard]] VkImage result() const { return resolves() ? result_.get() : colour_.get(); }
  [[nodiscard]] bool resolves() const { return spec_.samples != VK_SAMPLE_COUNT_1_BIT; }

 private:
  [[nodiscard]] std::array<VkAttachmentDescription, 3> attachments(VkFormat colour,
                                                                   VkFormat depth) const;
  void make_images(const Device& device);
  void make_pass(const Device& device);
  void make_depth_pass(const Device& device);
  void set_pass(const Device& device, VkRenderPassCreateInfo info);
  void make_framebuffers(const Device& device);
  Framebuffer framebuffer_of(const Device& device, VkImageView result) const;

  TargetSpec spec_;
  DeviceImage colour_;
  DeviceImage depth_;
  DeviceImage result_;  ///< of the resolve; empty with one sample
  std::vector<ImageView> outer_;
  RenderPass pass_;
  std::vector<Framebuffer> framebuffers_;
};

}  // namespace orthonav::render
