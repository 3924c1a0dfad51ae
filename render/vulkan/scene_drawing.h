#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "render/frame/frame_items.h"
#include "render/renderer.h"
#include "render/vulkan/bindings.h"
#include "render/vulkan/commands.h"
#include "render/vulkan/device.h"
#include "render/vulkan/frame_recorder.h"
#include "render/vulkan/mesh_cache.h"
#include "render/vulkan/pipeline_cache.h"

namespace orthonav::render {

/// Resources that belong to a frame until the device has drawn it.
struct FrameSlot {
  explicit FrameSlot(const Device& device);
  Commands commands;
  Bindings bindings;
  Buffer frames;        ///< one GpuFrame per pass
  Buffer data;          ///< FrameItems::data
  Buffer line_indices;  ///< for as many segments as any frame needed so far
};

/// What a frame shows; nothing here is owned.
struct Frame {
  const Scene& scene;
  const std::vector<View>& views;
  std::span<const RgbaImage* const> backgrounds;  ///< none, or one a view
  HeadTexts head_texts = HeadTexts::kDrawn;
};

/// Which of a frame's views are drawn.
struct DrawnViews {
  std::size_t first = 0;
  std::size_t count = kMaxViews;
};

/// A scene is checked, its meshes are uploaded, and it is laid out and written where the shaders
/// read it, wherever the frame ends. After the first frames it allocates nothing.
class SceneDrawing {
 public:
  /// Throws Failure if the device fails, as the other calls do. `device` must outlive it.
  SceneDrawing(const RendererOptions& options, const Device& device, VkPhysicalDevice physical);

  [[nodiscard]] const Device& device() const { return device_; }
  /// How many views a pass draws, according to the options or to a test of the device.
  [[nodiscard]] std::size_t views_a_pass() const { return views_a_pass_; }
  /// One with nothing behind the holograms.
  [[nodiscard]] std::unique_ptr<FrameSlot> make_slot() const;

  /// Checks the scene and uploads its meshes.
  [[nodiscard]] Status take(const Scene& scene);
  /// Whether colour is drawn with computed coverage.
  [[nodiscard]] bool covers() const { return drawn_edges(options_) == Edges::kCoverage; }
  /// Lays the scene out for its views in images of this size, into the slot, and finds the edges of
  /// its meshes in those that are `drawn`, where the pass smooths them.
  void build(const Frame& frame, PixelSize size, PassKind kind, DrawnViews drawn, FrameSlot& slot);
  /// The edges of the pass whose first view is `first`.
  [[nodiscard]] EdgeRanges edges(std::size_t first) const {
    return {edges_of_view_[first], edges_of_view_[(first + 1) % kMaxViews]};
  }
  /// For the pass whose first view is `first`: places its items and passes its views to the
  /// shaders.
  void place(std::span<const View> views, std::size_t first, PixelSize size, FrameSlot& slot);
  /// Marks the frame's end, however it ended.
  void end_frame() { meshes_.end_frame(); }

  [[nodiscard]] const FrameItems& items() const { return items_; }
  [[nodiscard]] const MeshCache& meshes() const { return meshes_; }
  [[nodiscard]] VkPipelineCache cache() const { return cache_.get(); }
  [[nodiscard]] const std::vector<std::string>& notes() const { return notes_; }

 private:
  void upload_atlas();
  void upload_blank();
  void choose_views_a_pass();
  /// `use` is given the edges of each surface of the frame, and where it is.
  template <class Use>
  void for_each_surface(const Use& use);
  void find_edges(const std::vector<View>& views, PixelSize size, DrawnViews drawn);
  void write_data(FrameSlot& slot) const;
  Status add_mesh(const MeshItem& item, const std::string& name);
  void note(std::string line);
  void note_missing_glyphs(const Scene& scene);

  RendererOptions options_;
  const Device& device_;
  PipelineCache cache_;
  Commands uploads_;
  Font font_;
  FrameItems items_;
  std::vector<Float4> edges_;  ///< of meshes in each view, as in SurfaceEdges
  EdgeRanges edges_of_view_;
  HiddenEdges hidden_edges_;  ///< in one view
  EdgeScratch edge_scratch_;
  MeshCache meshes_;
  DeviceImage atlas_;
  DeviceImage blank_;  ///< of one pixel: shaders want an image bound
  std::vector<std::string> notes_;
  std::vector<char32_t> missing_glyphs_;  ///< noted already
  std::size_t views_a_pass_ = 2;
};

}  // namespace orthonav::render
