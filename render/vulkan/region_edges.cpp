#include <algorithm>

#include "render/vulkan/commands.h"
#include "render/vulkan/region_recording.h"

// What only frames with computed coverage need (docs/decisions/0100-coverage-at-one-sample.md).

namespace orthonav::render {

void RegionRecording::cover_line(const SpanDraw& draw) const {
  push_line(draw);
  vkCmdDrawIndexed(commands_, draw.count * kIndicesPerQuad, 1,
                   (kIndicesPerSegment + kIndicesPerQuad) * line_capacity(sources_.line_indices), 0,
                   0);
}

void RegionRecording::covered_lines() const {
  const std::vector<SpanDraw>& draws = sources_.items.lines();
  bool indexed = false;
  for (std::size_t i = 0; i < draws.size();) {
    const std::size_t first = i;
    while (i < draws.size() && draws[i].item == draws[first].item) {
      ++i;
    }
    for (const Stage stage : {Stage::kLineCover, Stage::kLineColour}) {
      bool bound = false;
      for (std::size_t k = first; k < i; ++k) {
        if (!shows(draws[k].bounds, stage, bound)) {
          continue;
        }
        if (!indexed) {
          vkCmdBindIndexBuffer(commands_, sources_.line_indices.get(), 0, VK_INDEX_TYPE_UINT32);
          indexed = true;
        }
        cover_line(draws[k]);
      }
    }
  }
}

PixelRect RegionRecording::edges_within() const {
  PixelRect rect;
  if (!covers() || (sources_.edges[0].count == 0 && sources_.edges[1].count == 0)) {
    return rect;
  }
  for (const auto* meshes : {&sources_.items.translucent_meshes(), &sources_.items.solids()}) {
    for (const MeshDraw& draw : *meshes) {
      if (touch(draw.bounds, region_)) {
        rect = joined(rect, draw.bounds);
      }
    }
  }
  return rect;
}

void RegionRecording::edges() const {
  const auto& [left, right] = sources_.edges;
  const bool both = sources_.pass.targets.spec().views == 2;
  bool bound = false;
  if (shows(region_, Stage::kEdge, bound)) {
    push({kIdentity, {}, {}, {left.first, right.first, left.count, right.count}});
    vkCmdDraw(commands_, 6 * (both ? std::max(left.count, right.count) : left.count), 1, 0, 0);
  }
}

void RegionRecording::copy_drawn(const PixelRect& part) const {
  const TargetSpec& spec = sources_.pass.targets.spec();
  change_layout(commands_, {sources_.drawn, kMostViews, VK_IMAGE_LAYOUT_UNDEFINED,
                            VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL});
  VkImageCopy copy = {};
  copy.srcSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, spec.views};
  copy.dstSubresource = copy.srcSubresource;
  copy.srcSubresource.baseArrayLayer = sources_.pass.targets.first_layer(sources_.outer);
  copy.srcOffset = {part.left, part.top, 0};
  copy.dstOffset = copy.srcOffset;
  const VkRect2D rect = rect_of(part);
  copy.extent = {rect.extent.width, rect.extent.height, 1};
  vkCmdCopyImage(commands_, sources_.pass.targets.drawn(sources_.outer),
                 VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, sources_.drawn,
                 VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &copy);
  change_layout(commands_, {sources_.drawn, kMostViews, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                            VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL});
}

}  // namespace orthonav::render
