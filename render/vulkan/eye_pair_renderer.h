#pragma once

#include <array>
#include <memory>

#include "render/vulkan/vulkan_renderer.h"

namespace orthonav::render {

/// Draws each eye on a device of its own, at the same time. For devices that are the processor: a
/// software rasterizer prepares triangles in one thread and then fills pixels in all of them, so
/// that one eye's triangles are prepared while the other's pixels are filled
/// (docs/decisions/0114-a-device-for-each-eye.md).
class EyePairRenderer final : public Renderer {
 public:
  /// `left` draws frames of one view and labels too; `options`, with messages, are those of both.
  EyePairRenderer(const RendererOptions& options, std::unique_ptr<VulkanRenderer> left);

  Status draw(const Scene& scene, const std::vector<View>& views,
              const std::vector<const RgbaImage*>& backgrounds,
              std::vector<RgbaImage>& images) override;
  Status draw_labels(const Scene& scene, const std::vector<View>& views,
                     std::vector<LabelImage>& images) override;
  [[nodiscard]] const DeviceInfo& device() const override { return left().device(); }
  [[nodiscard]] FrameTiming last_timing() const override { return timing_; }
  [[nodiscard]] const std::vector<std::string>& validation_messages() const override {
    return left().validation_messages();
  }
  [[nodiscard]] const std::vector<std::string>& notes() const override { return left().notes(); }

 private:
  [[nodiscard]] VulkanRenderer& left() const { return *eyes_.front(); }
  Status draw_both(const EyeFrame& frame, std::vector<RgbaImage>& images);
  /// Remembers a lost device: the other one must not go on alone.
  Status remembered(Status drawn);

  RendererOptions options_;
  std::array<std::unique_ptr<VulkanRenderer>, kMaxViews> eyes_;  ///< right: with its first frame
  FrameTiming timing_;
  bool lost_ = false;
};

}  // namespace orthonav::render
