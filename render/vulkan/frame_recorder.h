#pragma once

#include "render/frame_items.h"
#include "render/vulkan/bindings.h"
#include "render/vulkan/mesh_cache.h"
#include "render/vulkan/pipelines.h"
#include "render/vulkan/targets.h"

namespace orthonav::render {

/// Images and the pipelines that fit them.
struct FramePass {
  FramePass(const Device& device, VkPipelineLayout layout, const TargetSpec& spec, Blend blend)
      : targets(device, spec), pipelines(device, layout, targets, blend) {}
  Targets targets;
  Pipelines pipelines;
};

/// Corners and indices of one segment of a line, as line.vert expects them.
inline constexpr std::uint32_t kCornersPerSegment = 14;
inline constexpr std::uint32_t kIndicesPerSegment = 36;

/// What the commands of one frame are made of; nothing here is owned.
struct FrameSources {
  const FramePass& pass;
  const Bindings& bindings;
  const MeshCache& meshes;
  const FrameItems& items;
  const Buffer& line_indices;
  const Buffer& readback;
  VkDeviceSize readback_offset = 0;
  bool has_background = false;
};

/// Records drawing and the copy of the result into the readback buffer. The rules of depth and
/// order that it follows are in docs/decisions/0021-holograms-need-no-order.md.
void record_frame(VkCommandBuffer commands, const FrameSources& sources);

}  // namespace orthonav::render
