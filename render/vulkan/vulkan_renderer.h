#pragma once

#include <array>
#include <memory>
#include <span>

#include "render/frame_items.h"
#include "render/renderer.h"
#include "render/vulkan/bindings.h"
#include "render/vulkan/commands.h"
#include "render/vulkan/device.h"
#include "render/vulkan/frame_recorder.h"
#include "render/vulkan/instance.h"
#include "render/vulkan/mesh_cache.h"
#include "render/vulkan/pipeline_cache.h"
#include "render/vulkan/pipelines.h"
#include "render/vulkan/targets.h"

namespace orthonav::render {

inline constexpr std::uint32_t kMostViews = 2;

/// Draws one frame after the other, each to its end, out of buffers that are kept.
class VulkanRenderer final : public Renderer {
 public:
  /// Throws VulkanFailure or std::runtime_error with one line.
  explicit VulkanRenderer(const RendererOptions& options);
  ~VulkanRenderer() override;
  VulkanRenderer(const VulkanRenderer&) = delete;
  VulkanRenderer& operator=(const VulkanRenderer&) = delete;

  [[nodiscard]] bool draw(const Scene& scene, const std::vector<View>& views,
                          const std::vector<const Image*>& backgrounds, std::vector<Image>& images,
                          std::string& error) override;
  [[nodiscard]] bool draw_labels(const Scene& scene, const std::vector<View>& views,
                                 std::vector<LabelImage>& images, std::string& error) override;
  [[nodiscard]] const DeviceInfo& device() const override { return info_; }
  [[nodiscard]] FrameTiming last_timing() const override { return timing_; }
  [[nodiscard]] const std::vector<std::string>& validation_messages() const override {
    return instance_.messages();
  }
  [[nodiscard]] const std::vector<std::string>& notes() const override { return notes_; }

 private:
  template <class Work>
  bool attempt(std::string& error, const Work& work);
  std::string line_of_failure();
  void draw_into(PassKind kind, const Scene& scene, const std::vector<View>& views,
                 const std::vector<const Image*>& backgrounds);
  template <class Picture, class Take>
  void read_back(std::size_t views, std::vector<Picture>& pictures, const Take& take_picture);
  std::string problem_of(const Scene& scene, const std::vector<View>& views,
                         const std::vector<const Image*>& backgrounds);
  std::string add_mesh(const MeshItem& item, const std::string& name);
  void note(std::string line);
  void note_missing_glyphs(const Scene& scene);
  const FramePass& pass_for(PassKind kind, std::size_t views);
  void record_pass(VkCommandBuffer batch, PassKind kind, std::span<const View> views,
                   std::span<const Image* const> backgrounds, std::size_t first);
  void upload_backgrounds(VkCommandBuffer batch, std::span<const Image* const> backgrounds,
                          std::size_t first);
  void write_frame(std::span<const View> views, std::size_t first, bool has_background);
  [[nodiscard]] float unseen_rad(const std::vector<View>& views) const;
  void prepare_data();
  std::size_t views_a_pass();
  void upload_atlas();
  void upload_blank_background();
  [[nodiscard]] std::size_t image_bytes() const;

  RendererOptions options_;
  Instance instance_;
  VkPhysicalDevice physical_;
  DeviceInfo info_;
  Device device_;
  PipelineCache cache_;
  Commands commands_;
  Bindings bindings_;
  Font font_;
  FrameItems items_;
  MeshCache meshes_;
  DeviceImage atlas_;
  DeviceImage background_;
  Buffer background_staging_;
  Buffer frames_;
  Buffer data_;
  Buffer line_indices_;
  Buffer readback_;
  std::array<std::unique_ptr<FramePass>, 4> passes_;  ///< by kind and number of views
  std::array<std::vector<PixelRect>, 2> drawn_;       ///< regions of each view
  std::vector<std::string> notes_;
  std::vector<char32_t> missing_glyphs_;  ///< noted already
  FrameTiming timing_;
  std::size_t views_a_pass_ = 2;
  bool lost_ = false;
};

}  // namespace orthonav::render
