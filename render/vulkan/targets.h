#pragma once

#include <array>
#include <vector>

#include "render/renderer.h"
#include "render/vulkan/memory.h"

namespace orthonav::render {

enum class PassKind {
  kColour,
  kLabels,
  kDepth  ///< of everything visible, for the host to know how far away it is
};

/// How edges are actually drawn: alpha can't hold both the coverage of lines and how much of the
/// world the host shows.
[[nodiscard]] inline Edges drawn_edges(const RendererOptions& options) {
  const bool full = options.blend == Blend::kPremultiplied && options.edges == Edges::kCoverage;
  return full ? Edges::kSamples : options.edges;
}

struct TargetSpec {
  PassKind kind = PassKind::kColour;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint32_t views = 1;
  Edges edges = Edges::kHard;  ///< of colour; other kinds always have hard edges
  VkFormat colour = kColourFormat;
  VkFormat depth = VK_FORMAT_UNDEFINED;  ///< of the outer images, where depth alone is drawn
  /// The host's images, one of which receives the result of a frame; empty: the targets have an
  /// image of their own.
  std::vector<VkImage> outer;
  /// Layers of each outer image: as many as there are views, or 2 if a pass draws a single view,
  /// and the passes fill one layer after the other.
  std::uint32_t outer_layers = 1;

  /// Whether the coverage of pixels is computed.
  [[nodiscard]] bool covers() const {
    return kind == PassKind::kColour && edges == Edges::kCoverage;
  }
  /// How many passes fill an outer image.
  [[nodiscard]] std::uint32_t passes_an_image() const {
    return outer.empty() ? 1 : outer_layers / views;
  }
  [[nodiscard]] VkSampleCountFlagBits samples() const {
    const bool several = kind == PassKind::kColour && edges == Edges::kSamples;
    return several ? VK_SAMPLE_COUNT_4_BIT : VK_SAMPLE_COUNT_1_BIT;
  }
};

/// A part of a frame between a begin and an end.
enum class PassPart {
  kWhole,
  kOpening,  ///< its result can be copied
  kClosing   ///< goes on drawing over that result
};

/// The images of one kind of frame, one layer a view, and the pass that draws into all layers at
/// once. The result is left ready to be copied from, or, in a host's image, as an attachment.
class Targets {
 public:
  Targets(const Device& device, const TargetSpec& spec);
  [[nodiscard]] const TargetSpec& spec() const { return spec_; }
  /// Parts other than the whole exist only for colour with computed coverage.
  [[nodiscard]] VkRenderPass pass(PassPart part = PassPart::kWhole) const {
    return passes_[static_cast<std::size_t>(part)].get();
  }
  /// `outer`, if there are outer images: the index of the image times `passes_an_image()`, plus the
  /// index of the pass.
  [[nodiscard]] VkFramebuffer framebuffer(std::size_t outer = 0) const {
    return framebuffers_[copies_result() ? 0 : outer].get();
  }
  /// The single-sample image to read, if it is the targets' own.
  [[nodiscard]] VkImage result() const { return resolves() ? result_.get() : colour_.get(); }
  /// The image that is drawn into, if nothing is resolved.
  [[nodiscard]] VkImage drawn(std::size_t outer) const {
    return spec_.outer.empty() ? colour_.get() : spec_.outer[outer / spec_.passes_an_image()];
  }
  /// The first layer of that image that the pass draws.
  [[nodiscard]] std::uint32_t first_layer(std::size_t outer) const {
    return static_cast<std::uint32_t>(outer % spec_.passes_an_image()) * spec_.views;
  }
  [[nodiscard]] bool resolves() const { return spec_.samples() != VK_SAMPLE_COUNT_1_BIT; }
  /// Whether the result is copied into a layer of the outer image after the pass: some drivers
  /// resolve samples into the first layer alone, whatever the view.
  [[nodiscard]] bool copies_result() const { return resolves() && spec_.passes_an_image() > 1; }
  /// Records that copy after the pass has ended; the outer image is left as an attachment.
  void copy_result(VkCommandBuffer commands, std::size_t outer) const;

 private:
  [[nodiscard]] std::array<VkAttachmentDescription, 3> attachments(VkFormat depth,
                                                                   PassPart part) const;
  void make_images(const Device& device);
  void make_pass(const Device& device, PassPart part);
  void make_depth_pass(const Device& device);
  void set_pass(const Device& device, VkRenderPassCreateInfo info,
                PassPart part = PassPart::kWhole);
  void make_framebuffers(const Device& device);
  Framebuffer framebuffer_of(const Device& device, VkImageView result) const;

  TargetSpec spec_;
  DeviceImage colour_;
  DeviceImage depth_;
  DeviceImage result_;  ///< samples are resolved into it, unless into an outer image
  std::vector<ImageView> outer_;
  std::array<RenderPass, 3> passes_;  ///< by part
  std::vector<Framebuffer> framebuffers_;
};

}  // namespace orthonav::render
