#include <algorithm>

#include "render/vulkan/gpu_types.h"
#include "render/vulkan/vulkan_renderer.h"

namespace orthonav::render {

/// Uploads the parts of them that shaders will read, for the pass whose first view is `first`.
void VulkanRenderer::upload_backgrounds(VkCommandBuffer batch,
                                        std::span<const RgbaImage* const> backgrounds,
                                        std::size_t first) {
  for (std::size_t i = 0; i < backgrounds.size(); ++i) {
    for (const PixelRect& region : drawing_.items().regions()) {
      for (int y = region.top; y < region.bottom; ++y) {
        const std::size_t at = 4 * (static_cast<std::size_t>(y) * options_.width_px + region.left);
        background_staging_.write(&backgrounds[i]->pixels[at],
                                  4 * static_cast<std::size_t>(region.width()),
                                  (first + i) * image_bytes() + at);
      }
    }
  }
  const VkExtent2D extent = {static_cast<std::uint32_t>(options_.width_px),
                             static_cast<std::uint32_t>(options_.height_px)};
  fill_image(batch,
             {background_staging_, background_, extent, 4,
              static_cast<std::uint32_t>(backgrounds.size()), kMaxViews, first * image_bytes()},
             drawing_.items().regions());
}

void VulkanRenderer::record_pass(VkCommandBuffer batch, PassKind kind, std::span<const View> views,
                                 std::span<const RgbaImage* const> backgrounds, std::size_t first) {
  drawing_.place(views, first, size());
  const FrameItems& items = drawing_.items();
  for (std::size_t i = 0; i < views.size(); ++i) {
    drawn_[first + i] = items.regions();
  }
  if (!backgrounds.empty()) {
    upload_backgrounds(batch, backgrounds, first);
  }
  const FrameSlot& slot = drawing_.slot();
  record_frame(batch, {pass_for(kind, views.size()), slot.bindings, drawing_.meshes(), items,
                       slot.line_indices, readback_, first * image_bytes(),
                       static_cast<std::uint32_t>(first * kFrameStride), !backgrounds.empty(), 0,
                       drawing_.edges(first), drawn_so_far_.get()});
}

void VulkanRenderer::submit(PassKind kind, const EyeFrame& frame, DrawnViews drawn) {
  drawing_.build(frame.scene, frame.views, size(), kind, drawn);
  Commands& commands = drawing_.slot().commands;
  const VkCommandBuffer batch = commands.begin();
  const std::size_t end = drawn.first + drawn.count;
  for (std::size_t first = drawn.first; first < end;) {
    const std::size_t count = std::min(end - first, drawing_.views_a_pass());
    const std::span<const RgbaImage* const> behind(frame.backgrounds);
    record_pass(batch, kind, std::span(frame.views).subspan(first, count),
                behind.empty() ? behind : behind.subspan(first, count), first);
    first += count;
  }
  timing_.record_ms = phase_.elapsed_ms();
  commands.submit();
  timing_.submit_ms = commands.submit_ms();
  phase_ = Stopwatch();
}

void VulkanRenderer::finish() {
  drawing_.slot().commands.wait();
  timing_.gpu_ms = phase_.elapsed_ms();
  phase_ = Stopwatch();
}

}  // namespace orthonav::render
