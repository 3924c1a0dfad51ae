#pragma once

#include <array>
#include <memory>
#include <span>

#include "base/stopwatch.h"
#include "render/renderer.h"
#include "render/vulkan/device.h"
#include "render/vulkan/instance.h"
#include "render/vulkan/scene_drawing.h"

namespace orthonav::render {

/// What one eye's part of a frame is drawn from; nothing here is owned.
struct EyeFrame {
  const Scene& scene;
  const std::vector<View>& views;  ///< of both eyes
  const std::vector<const RgbaImage*>& backgrounds;
};

/// Draws one frame at a time to completion, with buffers that it reuses.
class VulkanRenderer final : public Renderer {
 public:
  /// `options` must have been checked. Throws Failure.
  explicit VulkanRenderer(const RendererOptions& options);
  ~VulkanRenderer() override;
  VulkanRenderer(const VulkanRenderer&) = delete;
  VulkanRenderer& operator=(const VulkanRenderer&) = delete;

  Status draw(const Scene& scene, const std::vector<View>& views,
              const std::vector<const RgbaImage*>& backgrounds,
              std::vector<RgbaImage>& images) override;
  Status draw_labels(const Scene& scene, const std::vector<View>& views,
                     std::vector<LabelImage>& images) override;
  /// Begins to draw one eye's image of a frame. Without an Error, `end_eye` must follow with the
  /// same frame and image before anything else is drawn.
  Status begin_eye(const EyeFrame& frame, std::size_t eye, RgbaImage& image);
  /// Waits for the image that was begun.
  Status end_eye(const EyeFrame& frame, std::size_t eye, RgbaImage& image);
  [[nodiscard]] const DeviceInfo& device() const override { return info_; }
  [[nodiscard]] FrameTiming last_timing() const override { return timing_; }
  [[nodiscard]] const std::vector<std::string>& validation_messages() const override {
    return instance_.messages();
  }
  [[nodiscard]] const std::vector<std::string>& notes() const override { return drawing_.notes(); }

 private:
  template <class Work>
  Status attempt(const Work& work);
  template <class Work>
  Status guarded(const Work& work);
  /// Fills the pictures with what is behind the holograms while the device draws.
  template <class Picture, class Fill>
  Status draw_into(std::vector<Picture>& pictures, PassKind kind, const Scene& scene,
                   const std::vector<View>& views, const std::vector<const RgbaImage*>& backgrounds,
                   const Fill& fill_picture);
  /// What was taken.
  void submit(PassKind kind, const EyeFrame& frame, DrawnViews drawn);
  /// Waits for what was submitted.
  void finish();
  /// Checks everything and uploads the scene's meshes.
  Status take_input(const Scene& scene, const std::vector<View>& views,
                    const std::vector<const RgbaImage*>& backgrounds);
  const FramePass& pass_for(PassKind kind, std::size_t views);
  void record_pass(VkCommandBuffer batch, PassKind kind, std::span<const View> views,
                   std::span<const RgbaImage* const> backgrounds, std::size_t first);
  void upload_backgrounds(VkCommandBuffer batch, std::span<const RgbaImage* const> backgrounds,
                          std::size_t first);
  void upload_blank_background();
  [[nodiscard]] PixelSize size() const { return {options_.width_px, options_.height_px}; }
  [[nodiscard]] std::size_t image_bytes() const;

  RendererOptions options_;
  Instance instance_;
  VkPhysicalDevice physical_;
  DeviceInfo info_;
  Device device_;
  SceneDrawing drawing_;
  DeviceImage background_;
  DeviceImage drawn_so_far_;  ///< where coverage is computed
  Buffer background_staging_;
  Buffer readback_;
  std::array<std::unique_ptr<FramePass>, 4> passes_;  ///< by kind and number of views
  std::array<std::vector<PixelRect>, 2> drawn_;       ///< regions of each view
  FrameTiming timing_;
  Stopwatch phase_;  ///< since the last time that was put into `timing_`
  bool lost_ = false;
};

}  // namespace orthonav::render
