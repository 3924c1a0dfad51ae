#pragma once

#include <exception>
#include <memory>
#include <vector>

#include "render/hosted_renderer.h"
#include "render/vulkan/device.h"
#include "render/vulkan/failure.h"
#include "render/vulkan/instance.h"
#include "render/vulkan/scene_drawing.h"

namespace orthonav::render {

/// Two frames in flight on a host's device: each has its own command buffer, fence and buffers;
/// what they draw through (samples, depth) they share, one after the other in the queue.
class HostedVulkanRenderer final : public HostedRenderer {
 public:
  static constexpr std::size_t kFramesInFlight = 2;

  /// Throws Failure.
  HostedVulkanRenderer(const RendererOptions& options, VulkanHost& host);
  ~HostedVulkanRenderer() override;
  HostedVulkanRenderer(const HostedVulkanRenderer&) = delete;
  HostedVulkanRenderer& operator=(const HostedVulkanRenderer&) = delete;

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
  [[nodiscard]] Status check_images(const EyeImages& images) const;
  void make_passes();
  void make_panel_pass();
  void record_panel(const View& view, std::uint32_t index);
  void upload_blank_background();
  [[nodiscard]] bool offers(std::int64_t format, VkFormatFeatureFlags feature) const;
  void record(const std::vector<View>& views, std::span<const std::uint32_t> indices);

  RendererOptions options_;
  Instance instance_;
  VkPhysicalDevice physical_;
  DeviceInfo info_;
  Device device_;
  SceneDrawing drawing_;
  DeviceImage background_;    ///< of one pixel: shaders want one bound
  DeviceImage drawn_so_far_;  ///< where coverage is computed
  EyeImages images_;
  std::unique_ptr<FramePass> pass_;
  std::unique_ptr<FramePass> depth_pass_;  ///< where the host wants depth
  std::unique_ptr<FramePass> panel_pass_;  ///< where the host has a panel
  std::vector<View> panel_view_;
  FrameTiming timing_;
  bool lost_ = false;
};

/// Runs `work` and turns an exception into an Error.
template <class Work>
Status HostedVulkanRenderer::attempt(const Work& work) {
  if (lost_) {
    return Error{"renderer: device lost", ErrorCode::kLost};
  }
  try {
    return work();
  } catch (const std::exception&) {
    Error error = error_in_flight();
    lost_ = drawing_.lost() || error.code == ErrorCode::kLost;
    if (lost_) {
      error.code = ErrorCode::kLost;
    }
    return error;
  }
}

}  // namespace orthonav::render
