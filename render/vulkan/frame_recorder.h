#pragma once

#include <array>

#include "render/frame/frame_items.h"
#include "render/vulkan/bindings.h"
#include "render/vulkan/mesh_cache.h"
#include "render/vulkan/pipelines.h"
#include "render/vulkan/targets.h"

namespace orthonav::render {

/// Images and the pipelines that fit them.
struct FramePass {
  FramePass(const Device& device, VkPipelineCache cache, VkPipelineLayout layout,
            const TargetSpec& spec, Blend blend)
      : targets(device, spec), pipelines(device, cache, layout, targets, blend) {}
  Targets targets;
  Pipelines pipelines;
  float clear_alpha = 1;  ///< of a pixel without hologram
};

/// Corners and indices of one segment of a line, as line.vert expects them.
inline constexpr std::uint32_t kCornersPerSegment = 14;
inline constexpr std::uint32_t kIndicesPerSegment = 36;
/// Indices of a segment without discs at its ends. In the buffer of indices these come after all
/// the others.
inline constexpr std::uint32_t kIndicesPerQuad = 6;
/// After these, as many indices of the rectangles that line_cover.vert makes.
inline constexpr std::uint32_t kLineIndexBytes = 4 * (kIndicesPerSegment + 2 * kIndicesPerQuad);
/// How many segments a buffer of indices serves.
[[nodiscard]] inline std::uint32_t line_capacity(const Buffer& indices) {
  return static_cast<std::uint32_t>(indices.size() / kLineIndexBytes);
}

inline constexpr std::uint32_t kMaxViews = 2;

/// Edges of meshes in one view: where they begin in the data, and how many there are.
struct EdgeRange {
  std::uint32_t first = 0;
  std::uint32_t count = 0;
};
/// By view of a pass.
using EdgeRanges = std::array<EdgeRange, kMaxViews>;

/// What the commands of one frame are made from; nothing here is owned.
struct FrameSources {
  const FramePass& pass;
  const Bindings& bindings;
  const MeshCache& meshes;
  const FrameItems& items;
  const Buffer& line_indices;
  const Buffer& readback;  ///< empty where the target is someone else's image
  VkDeviceSize readback_offset = 0;
  std::uint32_t frame_offset = 0;  ///< of the pass's GpuFrame in the bound buffer
  bool has_background = false;
  std::size_t outer = 0;  ///< which of the targets' outer images
  EdgeRanges edges = {};
  VkImage drawn = VK_NULL_HANDLE;  ///< receives a copy of the drawn image before edges are smoothed
};

/// Records drawing a frame. In the targets' own images, the regions that hold holograms are drawn,
/// and each is copied into its place in the readback buffer; pixels outside are not touched. An
/// outer image is drawn whole. The rules of depth and order are in
/// docs/decisions/0021-holograms-need-no-order.md.
void record_frame(VkCommandBuffer commands, const FrameSources& sources);

}  // namespace orthonav::render
