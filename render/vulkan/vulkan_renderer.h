#pragma once

#include <memory>
#include <vector>

#include "render/renderer.h"
#include "render/vulkan/canvas.h"
#include "render/vulkan/device.h"
#include "render/vulkan/instance.h"
#include "render/vulkan/scene_drawing.h"

namespace orthonav::render {

/// One device, its own or a host's, and the canvases that it draws on. On a device that is the
/// processor, the right eye's images are drawn by a second renderer at the same time: a software
/// rasterizer prepares triangles in one thread and then fills pixels in all of them, so one eye's
/// triangles are prepared while the other's pixels are filled
/// (docs/decisions/0114-a-device-for-each-eye.md).
class VulkanRenderer final : public Renderer {
 public:
  /// `options` must have been checked. The host, if there is one, makes the device. Throws Failure.
  VulkanRenderer(const RendererOptions& options, VulkanHost* host);
  ~VulkanRenderer() override;
  VulkanRenderer(const VulkanRenderer&) = delete;
  VulkanRenderer& operator=(const VulkanRenderer&) = delete;

  Status draw(const Scene& scene, const std::vector<View>& views,
              const std::vector<const RgbaImage*>& backgrounds,
              std::vector<RgbaImage>& images) override;
  Status draw_labels(const Scene& scene, const std::vector<View>& views,
                     std::vector<LabelImage>& images) override;
  [[nodiscard]] VulkanObjects objects() const override;
  [[nodiscard]] int format_score(std::int64_t format) const override;
  [[nodiscard]] int depth_format_score(std::int64_t format) const override;
  Status use(const EyeImages& images) override;
  Status prepare(const Scene& scene) override;
  Status draw(const Scene& scene, const std::vector<View>& views,
              std::span<const std::uint32_t> indices, HeadTexts head_texts) override;
  Status draw_panel(const Scene& scene, const View& view, std::uint32_t index) override;
  Status finish() override;
  [[nodiscard]] bool lost() const override { return lost_; }
  [[nodiscard]] const DeviceInfo& device() const override { return info_; }
  [[nodiscard]] FrameTiming last_timing() const override { return timing_; }
  [[nodiscard]] const std::vector<std::string>& validation_messages() const override {
    return instance_.messages();
  }
  [[nodiscard]] const std::vector<std::string>& notes() const override { return drawing_.notes(); }

 private:
  template <class Work>
  Status attempt(const Work& work);
  template <class Picture>
  Status draw_pictures(PassKind kind, const Frame& frame, std::vector<Picture>& pictures);
  /// Begins to draw some views of a frame. Without an Error, `end` must follow before anything else
  /// is drawn.
  template <class Picture>
  Status begin(PassKind kind, const Frame& frame, DrawnViews drawn, std::vector<Picture>& pictures,
               FrameTiming& timing);
  /// Waits for what was begun.
  template <class Picture>
  Status end(const Frame& frame, DrawnViews drawn, std::vector<Picture>& pictures,
             FrameTiming& timing);
  [[nodiscard]] bool offers(std::int64_t format, VkFormatFeatureFlags feature) const;
  [[nodiscard]] Status check_images(const EyeImages& images) const;
  void release();

  RendererOptions options_;
  Instance instance_;
  VkPhysicalDevice physical_;
  DeviceInfo info_;
  Device device_;
  SceneDrawing drawing_;
  std::unique_ptr<Canvas> pictures_;  ///< images that are read back, from the first one on
  std::unique_ptr<Canvas> eyes_;      ///< images of others, while there are any
  std::unique_ptr<Canvas> panel_;     ///< the same
  std::vector<View> panel_view_;
  bool eyes_apart_;
  std::unique_ptr<VulkanRenderer> right_;  ///< with its first frame
  FrameTiming timing_;
  bool lost_ = false;
};

}  // namespace orthonav::render
