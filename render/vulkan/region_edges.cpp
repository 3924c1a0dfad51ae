#include <algorithm>

#include "render/vulkan/commands.h"
#include "render/vulkan/region_recording.h"

// What only frames with computed coverage need (docs/decisions/0100-coverage-at-one-sample.md).

namespace orthonav::render {
namespace {

/// As many pixels are filled in the time that one segment of a line takes.
constexpr long kSegment_px = 128;

}  // namespace

void RegionRecording::cover_lines(std::span<const SpanDraw> spans, Stage stage) const {
  bool bound = false;
  for (const SpanDraw& draw : spans) {
    if (!shows(draw.bounds, stage, bound)) {
      continue;
    }
    push_line(draw);
    vkCmdDrawIndexed(commands_, draw.count * kIndicesPerQuad, 1,
                     (kIndicesPerSegment + kIndicesPerQuad) * line_capacity(sources_.line_indices),
                     0, 0);
  }
}

/// Its colour needs no geometry: what the line does not cover has full alpha, and takes nothing.
void RegionRecording::colour_line(std::span<const SpanDraw> spans) const {
  PixelRect around;
  long segments = 0;
  for (const SpanDraw& draw : spans) {
    around = joined(around, overlap(draw.bounds, region_));
    segments += draw.count;
  }
  if (around.area() > kSegment_px * segments) {
    return cover_lines(spans, Stage::kLineColour);
  }
  bool bound = false;
  if (shows(around, Stage::kLineFill, bound)) {
    push_line(spans.front());
    fill(around);
  }
}

void RegionRecording::covered_lines() const {
  const std::vector<SpanDraw>& draws = sources_.items.lines();
  if (!draws.empty()) {
    vkCmdBindIndexBuffer(commands_, sources_.line_indices.get(), 0, VK_INDEX_TYPE_UINT32);
  }
  for (std::size_t i = 0; i < draws.size();) {
    const std::size_t first = i;
    while (i < draws.size() && draws[i].item == draws[first].item) {
      ++i;
    }
    const std::span line(&draws[first], i - first);
    cover_lines(line, Stage::kLineCover);
    colour_line(line);
  }
}

bool RegionRecording::shows_edges() const {
  const bool any = sources_.edges[0].count > 0 || sources_.edges[1].count > 0;
  return covers() && any && !edges_within(region_).empty();
}

PixelRect RegionRecording::edges_within(const PixelRect& part) const {
  PixelRect rect;
  for (const auto* meshes : {&sources_.items.translucent_meshes(), &sources_.items.solids()}) {
    for (const MeshDraw& draw : *meshes) {
      if (touch(draw.bounds, part)) {
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

void RegionRecording::copy_drawn() const {
  change_layout(commands_, {sources_.drawn, kMaxViews, VK_IMAGE_LAYOUT_UNDEFINED,
                            VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL});
  for (const PixelRect& region : sources_.items.regions()) {
    copy_drawn(edges_within(overlap(region, region_)));
  }
  change_layout(commands_, {sources_.drawn, kMaxViews, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                            VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL});
}

void RegionRecording::copy_drawn(const PixelRect& part) const {
  if (part.empty()) {
    return;
  }
  const TargetSpec& spec = sources_.pass.targets.spec();
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
}

}  // namespace orthonav::render
