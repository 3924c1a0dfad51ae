#include "render/vulkan/frame_recorder.h"

#include <algorithm>
#include <array>

#include "render/vulkan/commands.h"
#include "render/vulkan/gpu_types.h"

namespace orthonav::render {
namespace {

constexpr std::uint32_t kLastStencil = 255;

VkRect2D rect_of(const PixelRect& region) {
  return {
      {region.left, region.top},
      {static_cast<std::uint32_t>(region.width()), static_cast<std::uint32_t>(region.height())}};
}

/// Makes what follows wait for what was copied into the buffer.
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

/// One region of a frame while it is recorded.
class Recording {
 public:
  Recording(VkCommandBuffer commands, const FrameSources& sources, const PixelRect& region)
      : commands_(commands), sources_(sources), region_(region) {}

  void begin(PassPart part) const {
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
    vkCmdBindDescriptorSets(commands_, VK_PIPELINE_BIND_POINT_GRAPHICS, sources_.bindings.layout(),
                            0, 1, &sources_.bindings.set(), 1, &sources_.frame_offset);
  }

  void background() const {
    if (!sources_.has_background) {
      return;
    }
    bool bound = false;
    if (!shows(region_, Stage::kBackground, bound)) {
      return;
    }
    vkCmdDraw(commands_, 3, 1, 0, 0);
  }

  void meshes() const {
    const FrameItems& items = sources_.items;
    // Solids hide veils; veils hide one another, but nothing else: once they are drawn, the depth
    // is redrawn from the solids alone.
    mesh_stage(Stage::kDepth, items.solids());
    if (draws_depth()) {
      mesh_stage(Stage::kTranslucent, items.translucent_meshes());
      return;
    }
    if (mesh_stage(Stage::kTranslucent, items.translucent_meshes())) {
      clear(VK_IMAGE_ASPECT_DEPTH_BIT);
      mesh_stage(Stage::kDepth, items.solids());
    }
    mesh_stage(Stage::kSolid, items.solids());
  }

  void triangles() const {
    bool bound = false;
    for (const SpanDraw& draw : sources_.items.triangles()) {
      if (!shows(draw.bounds, Stage::kTriangle, bound)) {
        continue;
      }
      push({kIdentity, draw.colour, {}, {draw.label, draw.first}});
      vkCmdDraw(commands_, draw.count, 1, 0, 0);
    }
  }

  void lines() const {
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

  void texts() const {
    bool bound = false;
    for (const TextDraw& draw : sources_.items.texts()) {
      if (!shows(draw.bounds, Stage::kText, bound)) {
        continue;
      }
      const Colour& rim = draw.rim;
      push({draw.world_from_caps, {}, {rim.r, rim.g, rim.b, rim.a}, {draw.label, draw.first}});
      vkCmdDraw(commands_, 6 * draw.count, 1, 0, 0);
    }
  }

  void everything() const {
    const PixelRect smoothed = edges_within();
    begin(smoothed.empty() ? PassPart::kWhole : PassPart::kOpening);
    background();
    meshes();
    triangles();
    lines();
    if (!smoothed.empty()) {
      vkCmdEndRenderPass(commands_);
      copy_drawn(smoothed);
      begin(PassPart::kClosing);
      edges();
    }
    texts();
    vkCmdEndRenderPass(commands_);
  }

  void copy() const {
    const TargetSpec& spec = sources_.pass.targets.spec();
    // Rows of adjacent regions alternate in the buffer: one copy after the other.
    wait_for_copies(commands_, sources_.readback, VK_PIPELINE_STAGE_TRANSFER_BIT,
                    VK_ACCESS_TRANSFER_WRITE_BIT);
    // Into its place in the whole image, so that a reader needs to know the regions only.
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

 private:
  [[nodiscard]] bool draws_depth() const {
    return sources_.pass.targets.spec().kind == PassKind::kDepth;
  }
  /// Whether it shows in this region; binds the stage's pipeline before the first item that does.
  bool shows(const PixelRect& bounds, Stage stage, bool& bound) const {
    if (!touch(bounds, region_)) {
      return false;
    }
    if (!bound) {
      vkCmdBindPipeline(commands_, VK_PIPELINE_BIND_POINT_GRAPHICS,
                        sources_.pass.pipelines.get(stage));
    }
    return bound = true;
  }

  void next_stencil(std::uint32_t& stencil) const {
    if (stencil == kLastStencil) {
      clear(VK_IMAGE_ASPECT_STENCIL_BIT);
      stencil = 0;
    }
    vkCmdSetStencilReference(commands_, VK_STENCIL_FACE_FRONT_AND_BACK, ++stencil);
  }

  void push(const GpuItem& item) const {
    vkCmdPushConstants(commands_, sources_.bindings.layout(),
                       VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT, 0, sizeof(item),
                       &item);
  }

  [[nodiscard]] bool covers() const { return sources_.pass.targets.spec().covers(); }

  void push_line(const SpanDraw& draw) const {
    const std::uint32_t rounded = draw.rounded ? 1 : 0;
    push({kIdentity, draw.colour, {draw.width_m}, {draw.label, draw.first, 0, rounded}});
  }

  void cover_line(const SpanDraw& draw) const {
    push_line(draw);
    vkCmdDrawIndexed(commands_, draw.count * kIndicesPerQuad, 1,
                     (kIndicesPerSegment + kIndicesPerQuad) * line_capacity(sources_.line_indices),
                     0, 0);
  }

  /// All of one line into alpha, which then says how much of its colour is added; the stencil is
  /// not needed.
  void covered_lines() const {
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

  /// The part of the region whose pixels edges of meshes may cut; empty where there are none.
  [[nodiscard]] PixelRect edges_within() const {
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

  void edges() const {
    const auto& [left, right] = sources_.edges;
    const bool both = sources_.pass.targets.spec().views == 2;
    bool bound = false;
    if (shows(region_, Stage::kEdge, bound)) {
      push({kIdentity, {}, {}, {left.first, right.first, left.count, right.count}});
      vkCmdDraw(commands_, 6 * (both ? std::max(left.count, right.count) : left.count), 1, 0, 0);
    }
  }

  void copy_drawn(const PixelRect& part) const {
    const TargetSpec& spec = sources_.pass.targets.spec();
    change_layout(commands_, {sources_.drawn, kMostViews, VK_IMAGE_LAYOUT_UNDEFINED,
                              VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL});
    VkImageCopy copy = {};
    copy.srcSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, spec.views};
    copy.dstSubresource = copy.srcSubresource;
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

  /// Clears depth or stencil of every view, as at the frame's beginning.
  void clear(VkImageAspectFlags aspect) const {
    VkClearAttachment attachment = {};
    attachment.aspectMask = aspect;
    attachment.clearValue.depthStencil = {1.0f, 0};
    const VkClearRect everywhere = {rect_of(region_), 0, 1};
    vkCmdClearAttachments(commands_, 1, &attachment, 1, &everywhere);
  }

  /// Draws the meshes of a stage; whether there were any.
  bool mesh_stage(Stage stage, const std::vector<MeshDraw>& meshes) const {
    bool bound = false;
    for (const auto& [item, bounds] : meshes) {
      const GpuMesh* copy = sources_.meshes.find(item->mesh);
      if (copy == nullptr || copy->index_count == 0 || !shows(bounds, stage, bound)) {
        continue;
      }
      const std::uint32_t style = item->style == MeshStyle::kRim ? 1 : 0;
      const Colour& tint = item->tint;
      push({item->world_from_model,
            item->colour,
            {tint.r, tint.g, tint.b},
            {item->label, 0, style}});
      const VkBuffer vertices = copy->vertices.get();
      const VkDeviceSize offset = 0;
      vkCmdBindVertexBuffers(commands_, 0, 1, &vertices, &offset);
      vkCmdBindIndexBuffer(commands_, copy->indices.get(), 0, VK_INDEX_TYPE_UINT32);
      vkCmdDrawIndexed(commands_, copy->index_count, 1, 0, 0, 0);
    }
    return bound;
  }

  VkCommandBuffer commands_;
  const FrameSources& sources_;
  PixelRect region_;
};

}  // namespace

void record_frame(VkCommandBuffer commands, const FrameSources& sources) {
  for (const PixelRect& region : sources.items.regions()) {
    const Recording part(commands, sources, region);
    part.everything();
    part.copy();
  }
  wait_for_copies(commands, sources.readback, VK_PIPELINE_STAGE_HOST_BIT, VK_ACCESS_HOST_READ_BIT);
}

void record_outer_frame(VkCommandBuffer commands, const FrameSources& sources) {
  const TargetSpec& spec = sources.pass.targets.spec();
  const PixelRect whole{0, 0, static_cast<int>(spec.width), static_cast<int>(spec.height)};
  Recording(commands, sources, whole).everything();
}

}  // namespace orthonav::render
