#include "render/vulkan/frame_recorder.h"

#include <array>

#include "render/vulkan/gpu_types.h"

namespace orthonav::render {
namespace {

constexpr std::uint32_t kLastStencil = 255;

/// One frame being written down.
class Recording {
 public:
  Recording(VkCommandBuffer commands, const FrameSources& sources)
      : commands_(commands), sources_(sources) {}

  void begin() const {
    const TargetSpec& spec = sources_.pass.targets.spec();
    std::array<VkClearValue, 3> clear = {};
    // Colour to opaque black; a label to 0 everywhere.
    if (spec.kind == PassKind::kColour) clear[0].color.float32[3] = 1.0f;
    clear[1].depthStencil = {1.0f, 0};
    VkRenderPassBeginInfo info = {};
    info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO;
    info.renderPass = sources_.pass.targets.pass();
    info.framebuffer = sources_.pass.targets.framebuffer();
    info.renderArea = {{0, 0}, {spec.width, spec.height}};
    info.clearValueCount = 2;
    info.pClearValues = clear.data();
    vkCmdBeginRenderPass(commands_, &info, VK_SUBPASS_CONTENTS_INLINE);
    vkCmdBindDescriptorSets(commands_, VK_PIPELINE_BIND_POINT_GRAPHICS, sources_.bindings.layout(),
                            0, 1, &sources_.bindings.set(), 0, nullptr);
  }

  void background() const {
    if (!sources_.has_background) return;
    bind(Stage::kBackground);
    vkCmdDraw(commands_, 3, 1, 0, 0);
  }

  void meshes() const {
    const FrameItems& items = sources_.items;
    // Solids hide veils; veils hide one another, but nothing else: once they are drawn, the depth
    // is made anew from the solids alone.
    mesh_stage(Stage::kDepth, items.solids());
    mesh_stage(Stage::kVeil, items.veils());
    if (items.solids().empty()) {
      if (!items.veils().empty()) clear(VK_IMAGE_ASPECT_DEPTH_BIT);
      return;
    }
    if (!items.veils().empty()) {
      clear(VK_IMAGE_ASPECT_DEPTH_BIT);
      mesh_stage(Stage::kDepth, items.solids());
    }
    mesh_stage(Stage::kSolid, items.solids());
  }

  void triangles() const {
    if (sources_.items.triangles().empty()) return;
    bind(Stage::kTriangle);
    for (const SpanDraw& draw : sources_.items.triangles()) {
      push({kIdentity, draw.colour, {}, {draw.label, draw.first}});
      vkCmdDraw(commands_, draw.count, 1, 0, 0);
    }
  }

  void lines() const {
    if (sources_.items.lines().empty()) return;
    bind(Stage::kLine);
    vkCmdBindIndexBuffer(commands_, sources_.line_indices.get(), 0, VK_INDEX_TYPE_UINT32);
    std::uint32_t stencil = 0;
    for (const SpanDraw& draw : sources_.items.lines()) {
      if (stencil == kLastStencil) {
        clear(VK_IMAGE_ASPECT_STENCIL_BIT);
        stencil = 0;
      }
      vkCmdSetStencilReference(commands_, VK_STENCIL_FACE_FRONT_AND_BACK, ++stencil);
      push({kIdentity, draw.colour, {draw.width_m}, {draw.label, draw.first}});
      vkCmdDrawIndexed(commands_, draw.count * kIndicesPerSegment, 1, 0, 0, 0);
    }
  }

  void texts() const {
    if (sources_.items.texts().empty()) return;
    bind(Stage::kText);
    for (const TextDraw& draw : sources_.items.texts()) {
      const Colour& rim = draw.rim;
      push({draw.world_from_caps, {}, {rim.r, rim.g, rim.b, rim.a}, {draw.label, draw.first}});
      vkCmdDraw(commands_, 6 * draw.count, 1, 0, 0);
    }
  }

  void end_and_copy() const {
    vkCmdEndRenderPass(commands_);
    const TargetSpec& spec = sources_.pass.targets.spec();
    VkBufferImageCopy region = {};
    region.bufferOffset = sources_.readback_offset;
    region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, spec.views};
    region.imageExtent = {spec.width, spec.height, 1};
    vkCmdCopyImageToBuffer(commands_, sources_.pass.targets.result(),
                           VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, sources_.readback.get(), 1,
                           &region);
    VkBufferMemoryBarrier barrier = {};
    barrier.sType = VK_STRUCTURE_TYPE_BUFFER_MEMORY_BARRIER;
    barrier.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_HOST_READ_BIT;
    barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.buffer = sources_.readback.get();
    barrier.size = VK_WHOLE_SIZE;
    vkCmdPipelineBarrier(commands_, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_HOST_BIT, 0,
                         0, nullptr, 1, &barrier, 0, nullptr);
  }

 private:
  void bind(Stage stage) const {
    vkCmdBindPipeline(commands_, VK_PIPELINE_BIND_POINT_GRAPHICS,
                      sources_.pass.pipelines.get(stage));
  }

  void push(const GpuItem& item) const {
    vkCmdPushConstants(commands_, sources_.bindings.layout(),
                       VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT, 0, sizeof(item),
                       &item);
  }

  /// Depth or stencil of every view, as at the frame's beginning.
  void clear(VkImageAspectFlags aspect) const {
    const TargetSpec& spec = sources_.pass.targets.spec();
    VkClearAttachment attachment = {};
    attachment.aspectMask = aspect;
    attachment.clearValue.depthStencil = {1.0f, 0};
    const VkClearRect everywhere = {{{0, 0}, {spec.width, spec.height}}, 0, 1};
    vkCmdClearAttachments(commands_, 1, &attachment, 1, &everywhere);
  }

  void mesh_stage(Stage stage, const std::vector<const MeshItem*>& meshes) const {
    if (meshes.empty()) return;
    bind(stage);
    for (const MeshItem* item : meshes) {
      const GpuMesh* copy = sources_.meshes.find(item->mesh);
      if (copy == nullptr || copy->index_count == 0) continue;
      const std::uint32_t style = item->style == MeshStyle::kRim ? 1 : 0;
      push({item->world_from_model, item->colour, {}, {item->label, 0, style}});
      const VkBuffer vertices = copy->vertices.get();
      const VkDeviceSize offset = 0;
      vkCmdBindVertexBuffers(commands_, 0, 1, &vertices, &offset);
      vkCmdBindIndexBuffer(commands_, copy->indices.get(), 0, VK_INDEX_TYPE_UINT32);
      vkCmdDrawIndexed(commands_, copy->index_count, 1, 0, 0, 0);
    }
  }

  VkCommandBuffer commands_;
  const FrameSources& sources_;
};

}  // namespace

void record_frame(VkCommandBuffer commands, const FrameSources& sources) {
  const Recording frame(commands, sources);
  frame.begin();
  frame.background();
  frame.meshes();
  frame.triangles();
  frame.lines();
  frame.texts();
  frame.end_and_copy();
}

}  // namespace orthonav::render
