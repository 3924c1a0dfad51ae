#pragma once

#include <span>
#include <vector>

#include "render/vulkan/frame_recorder.h"
#include "render/vulkan/gpu_types.h"

namespace orthonav::render {

/// One region of a frame while it is recorded.
class RegionRecording {
 public:
  RegionRecording(VkCommandBuffer commands, const FrameSources& sources, const PixelRect& region)
      : commands_(commands), sources_(sources), region_(region) {}

  /// Draws everything visible in it.
  void everything() const;
  /// Copies it into its place in the readback buffer.
  void copy() const;

 private:
  void begin(PassPart part) const;
  void background() const;
  void meshes() const;
  /// Draws the bound stage, one that covers everything, over a part of the region.
  void fill(const PixelRect& part) const;
  /// Sets the depth of a part of the region as it was at the frame's beginning.
  void forget_depth(const PixelRect& part) const;
  void triangles() const;
  void lines() const;
  void texts() const;
  [[nodiscard]] bool draws_depth() const;
  /// Whether an item with these bounds is visible in this region; binds the stage's pipeline before
  /// the first such item.
  bool shows(const PixelRect& bounds, Stage stage, bool& bound) const;
  void next_stencil(std::uint32_t& stencil) const;
  void push(const GpuItem& item) const;
  [[nodiscard]] bool covers() const { return sources_.pass.targets.spec().covers(); }

  void push_line(const SpanDraw& draw) const;
  /// Draws the segments of one line.
  void cover_lines(std::span<const SpanDraw> spans, Stage stage) const;
  void colour_line(std::span<const SpanDraw> spans) const;
  /// Draws each line into alpha first, which then says how much of its colour is added; no stencil
  /// is needed.
  void covered_lines() const;
  /// Whether edges of meshes may cut pixels of the region.
  [[nodiscard]] bool shows_edges() const;
  /// The pixels of a part that edges of meshes may cut; empty where there are none.
  [[nodiscard]] PixelRect edges_within(const PixelRect& part) const;
  void edges() const;
  /// Copies the pixels that edges may cut, for the edges to read.
  void copy_drawn() const;
  void copy_drawn(const PixelRect& part) const;
  /// Clears depth or stencil of every view, as at the frame's beginning.
  void clear(VkImageAspectFlags aspect, const PixelRect& part) const;
  /// Draws the meshes of a stage; returns whether there were any.
  bool mesh_stage(Stage stage, const std::vector<MeshDraw>& meshes) const;
  /// The same, of those that may touch `within`.
  bool mesh_stage(Stage stage, const std::vector<MeshDraw>& meshes, const PixelRect& within) const;

  VkCommandBuffer commands_;
  const FrameSources& sources_;
  PixelRect region_;
};

/// The rectangle in Vulkan's form.
[[nodiscard]] VkRect2D rect_of(const PixelRect& region);
/// Makes later work wait for the copies into the buffer.
void wait_for_copies(VkCommandBuffer commands, const Buffer& readback, VkPipelineStageFlags stage,
                     VkAccessFlags access);

}  // namespace orthonav::render
