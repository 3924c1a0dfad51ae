#pragma once

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
  void cover_line(const SpanDraw& draw) const;
  /// Draws each line into alpha first, which then says how much of its colour is added; no stencil
  /// is needed.
  void covered_lines() const;
  /// The part of the region whose pixels edges of meshes may cut; empty where there are none.
  [[nodiscard]] PixelRect edges_within() const;
  void edges() const;
  void copy_drawn(const PixelRect& part) const;
  /// Clears depth or stencil of every view, as at the frame's beginning.
  void clear(VkImageAspectFlags aspect) const;
  /// Draws the meshes of a stage; returns whether there were any.
  bool mesh_stage(Stage stage, const std::vector<MeshDraw>& meshes) const;

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
