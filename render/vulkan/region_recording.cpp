#include "render/vulkan/region_recording.h"

#include <array>

namespace orthonav::render {
namespace {

constexpr std::uint32_t kLastStencil = 255;

}  // namespace

VkRect2D rect_of(const PixelRect& region) {
  return {
      {region.left, region.top},
      {static_cast<std::uint32_t>(region.width()), static_cast<std::uint32_t>(region.height())}};
}

void wait_for_copies(VkCommandBuffer commands, const Buffer& readback, VkPipelineStageFlags stage,
                     VkAccessFlags access) {
  VkBufferMemoryBarrier barrier = {};
  barrier.sType = VK_STRUCTURE_TYPE_BUFFER_MEMORY_BARRIER;
  barrier.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
  barrier.dstAccessMask = access;
  barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.buffer = readback.get();
  barrier.size = VK_WHOLE_SIZE;
  vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, stage, 0, 0, nullptr, 1, &barrier,
                       0, nullptr);
}

void RegionRecording::begin(PassPart part) const {
  std::array<VkClearValue, 3> clear = {};
  // Colour is cleared to black, opaque or fully transparent; a label to 0 everywhere.
  if (sources_.pass.targets.spec().kind == PassKind::kColour) {
    clear[0].color.float32[3] = sources_.pass.clear_alpha;
  }
  clear[draws_depth() ? 0 : 1].depthStencil = {1.0f, 0};
  VkRenderPassBeginInfo info = {};
  info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO;
  info.renderPass = sources_.pass.targets.pass(part);
  info.framebuffer = sources_.pass.targets.framebuffer(sources_.outer);
  info.renderArea = rect_of(region_);
  if (part != PassPart::kClosing) {
    info.clearValueCount = draws_depth() ? 1 : 2;
    info.pClearValues = clear.data();
  }
  vkCmdBeginRenderPass(commands_, &info, VK_SUBPASS_CONTENTS_INLINE);
  vkCmdSetScissor(commands_, 0, 1, &info.renderArea);
  vkCmdBindDescriptorSets(commands_, VK_PIPELINE_BIND_POINT_GRAPHICS, sources_.bindings.layout(), 0,
                          1, &sources_.bindings.set(), 1, &sources_.frame_offset);
}

void RegionRecording::background() const {
  if (!sources_.has_background) {
    return;
  }
  bool bound = false;
  if (!shows(region_, Stage::kBackground, bound)) {
    return;
  }
  for (const PixelRect& region : sources_.items.regions()) {
    fill(overlap(region, region_));
  }
}

void RegionRecording::meshes() const {
  const FrameItems& items = sources_.items;
  // Solids hide veils; veils hide one another, but nothing else: once they are drawn, the depth
  // is redrawn from the solids alone.
  mesh_stage(Stage::kDepth, items.solids());
  if (draws_depth()) {
    mesh_stage(Stage::kTranslucent, items.translucent_meshes());
    return;
  }
  PixelRect veiled;
  for (const MeshDraw& draw : items.translucent_meshes()) {
    veiled = joined(veiled, overlap(draw.bounds, region_));
  }
  const bool over =
      sources_.has_background && has_stage(Stage::kOverBackground, sources_.pass.targets.spec());
  if (mesh_stage(over ? Stage::kOverBackground : Stage::kTranslucent, items.translucent_meshes())) {
    forget_depth(veiled);
    mesh_stage(Stage::kDepth, items.solids(), veiled);
  }
  mesh_stage(Stage::kSolid, items.solids());
}

void RegionRecording::fill(const PixelRect& part) const {
  if (part.empty()) {
    return;
  }
  const VkRect2D inner = rect_of(part);
  const VkRect2D outer = rect_of(region_);
  vkCmdSetScissor(commands_, 0, 1, &inner);
  vkCmdDraw(commands_, 3, 1, 0, 0);
  vkCmdSetScissor(commands_, 0, 1, &outer);
}

void RegionRecording::forget_depth(const PixelRect& part) const {
  // For a clear, llvmpipe first waits for all that was drawn; but of two views it would draw over
  // the first alone (docs/decisions/0022-both-eyes-in-one-pass.md).
  if (sources_.pass.targets.spec().views > 1) {
    return clear(VK_IMAGE_ASPECT_DEPTH_BIT, part);
  }
  bool bound = false;
  if (shows(part, Stage::kFarthest, bound)) {
    fill(part);
  }
}

void RegionRecording::triangles() const {
  bool bound = false;
  for (const SpanDraw& draw : sources_.items.triangles()) {
    if (!shows(draw.bounds, Stage::kTriangle, bound)) {
      continue;
    }
    push({kIdentity, draw.colour, {}, {draw.label, draw.first, 0, 0}});
    vkCmdDraw(commands_, draw.count, 1, 0, 0);
  }
}

void RegionRecording::lines() const {
  if (covers()) {
    return covered_lines();
  }
  bool bound = false;
  bool first = true;
  std::uint32_t stencil = 0;
  std::uint32_t item = 0;
  for (const SpanDraw& draw : sources_.items.lines()) {
    if (!shows(draw.bounds, Stage::kLine, bound)) {
      continue;
    }
    if (first) {
      vkCmdBindIndexBuffer(commands_, sources_.line_indices.get(), 0, VK_INDEX_TYPE_UINT32);
    }
    // Depth may be written any number of times: it needs no stencil.
    if (!draws_depth() && (first || draw.item != item)) {
      next_stencil(stencil);
    }
    first = false;
    item = draw.item;
    push_line(draw);
    if (draw.rounded) {
      vkCmdDrawIndexed(commands_, draw.count * kIndicesPerSegment, 1, 0, 0, 0);
    } else {
      vkCmdDrawIndexed(commands_, draw.count * kIndicesPerQuad, 1,
                       kIndicesPerSegment * line_capacity(sources_.line_indices), 0, 0);
    }
  }
}

void RegionRecording::texts() const {
  bool bound = false;
  for (const TextDraw& draw : sources_.items.texts()) {
    if (!shows(draw.bounds, Stage::kText, bound)) {
      continue;
    }
    const Colour& rim = draw.rim;
    push({draw.world_from_caps, {}, {rim.r, rim.g, rim.b, rim.a}, {draw.label, draw.first, 0, 0}});
    vkCmdDraw(commands_, 6 * draw.count, 1, 0, 0);
  }
}

void RegionRecording::everything() const {
  const bool smoothed = shows_edges();
  begin(smoothed ? PassPart::kOpening : PassPart::kWhole);
  background();
  meshes();
  triangles();
  lines();
  if (smoothed) {
    vkCmdEndRenderPass(commands_);
    copy_drawn();
    begin(PassPart::kClosing);
    edges();
  }
  texts();
  vkCmdEndRenderPass(commands_);
}

void RegionRecording::copy() const {
  const TargetSpec& spec = sources_.pass.targets.spec();
  // Rows of adjacent regions alternate in the buffer: one copy after the other.
  wait_for_copies(commands_, sources_.readback, VK_PIPELINE_STAGE_TRANSFER_BIT,
                  VK_ACCESS_TRANSFER_WRITE_BIT);
  // Each region keeps its place in the whole image, so a reader needs to know only the regions.
  const auto pixel = std::size_t{spec.width} * region_.top + region_.left;
  VkBufferImageCopy copy = {};
  copy.bufferOffset = sources_.readback_offset + 4 * pixel;
  copy.bufferRowLength = spec.width;
  copy.bufferImageHeight = spec.height;
  copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, spec.views};
  copy.imageOffset = {region_.left, region_.top, 0};
  const VkRect2D rect = rect_of(region_);
  copy.imageExtent = {rect.extent.width, rect.extent.height, 1};
  vkCmdCopyImageToBuffer(commands_, sources_.pass.targets.result(),
                         VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, sources_.readback.get(), 1, &copy);
}

bool RegionRecording::draws_depth() const {
  return sources_.pass.targets.spec().kind == PassKind::kDepth;
}

bool RegionRecording::shows(const PixelRect& bounds, Stage stage, bool& bound) const {
  if (!touch(bounds, region_)) {
    return false;
  }
  if (!bound) {
    vkCmdBindPipeline(commands_, VK_PIPELINE_BIND_POINT_GRAPHICS,
                      sources_.pass.pipelines.get(stage));
  }
  return bound = true;
}

void RegionRecording::next_stencil(std::uint32_t& stencil) const {
  if (stencil == kLastStencil) {
    clear(VK_IMAGE_ASPECT_STENCIL_BIT, region_);
    stencil = 0;
  }
  vkCmdSetStencilReference(commands_, VK_STENCIL_FACE_FRONT_AND_BACK, ++stencil);
}

void RegionRecording::push(const GpuItem& item) const {
  vkCmdPushConstants(commands_, sources_.bindings.layout(),
                     VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT, 0, sizeof(item),
                     &item);
}

void RegionRecording::push_line(const SpanDraw& draw) const {
  const std::uint32_t rounded = draw.rounded ? 1 : 0;
  push({kIdentity, draw.colour, {draw.width_m, 0, 0, 0}, {draw.label, draw.first, 0, rounded}});
}

void RegionRecording::clear(VkImageAspectFlags aspect, const PixelRect& part) const {
  VkClearAttachment attachment = {};
  attachment.aspectMask = aspect;
  attachment.clearValue.depthStencil = {1.0f, 0};
  const VkClearRect everywhere = {rect_of(part), 0, 1};
  vkCmdClearAttachments(commands_, 1, &attachment, 1, &everywhere);
}

bool RegionRecording::mesh_stage(Stage stage, const std::vector<MeshDraw>& meshes) const {
  return mesh_stage(stage, meshes, region_);
}

bool RegionRecording::mesh_stage(Stage stage, const std::vector<MeshDraw>& meshes,
                                 const PixelRect& within) const {
  bool bound = false;
  for (const auto& [item, bounds, number] : meshes) {
    const GpuMesh* copy = sources_.meshes.find(item->mesh);
    if (copy == nullptr || copy->levels.empty() || !touch(bounds, within) ||
        !shows(bounds, stage, bound)) {
      continue;
    }
    const GpuMesh::Level& level = copy->levels[number];
    const std::uint32_t style = item->style == MeshStyle::kRim ? 1 : 0;
    const Colour& tint = item->tint;
    push({item->world_from_model,
          item->colour,
          {tint.r, tint.g, tint.b, 0},
          {item->label, 0, style, 0}});
    const VkBuffer vertices = copy->vertices.get();
    const VkDeviceSize offset = 0;
    vkCmdBindVertexBuffers(commands_, 0, 1, &vertices, &offset);
    vkCmdBindIndexBuffer(commands_, copy->indices.get(), 0, VK_INDEX_TYPE_UINT32);
    vkCmdDrawIndexed(commands_, level.index_count, 1, level.first_index, 0, 0);
  }
  return bound;
}

}  // namespace orthonav::render
