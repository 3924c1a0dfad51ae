#include "render/vulkan/canvas.h"

#include <algorithm>

#include "render/vulkan/gpu_types.h"

namespace orthonav::render {
namespace {

/// Every image that a pass may end in, chain after chain.
std::vector<VkImage> outer_images(const std::vector<std::vector<std::uint64_t>>& chains) {
  std::vector<VkImage> outer;
  for (const auto& chain : chains) {
    for (const std::uint64_t image : chain) {
      outer.push_back(reinterpret_cast<VkImage>(image));
    }
  }
  return outer;
}

}  // namespace

Canvas::Canvas(SceneDrawing& drawing, const EyeImages& images, const Look& look, std::size_t frames)
    : drawing_(drawing),
      images_(images),
      look_(look),
      views_a_pass_(own() ? drawing.views_a_pass()
                          : std::min<std::size_t>(images.layers, drawing.views_a_pass())) {
  for (std::size_t i = 0; i < frames; ++i) {
    slots_.push_back(drawing.make_slot());
  }
  if (look.edges == Edges::kCoverage) {
    drawn_so_far_ = sampled_image(own() ? kColourFormat : static_cast<VkFormat>(images.format));
    for (const auto& slot : slots_) {
      slot->bindings.bind_drawn(drawn_so_far_);
    }
  }
  if (own()) {
    readback_ = Buffer(drawing.device(), kMaxViews * image_bytes(),
                       VK_BUFFER_USAGE_TRANSFER_DST_BIT, BufferPlace::kReadback);
    return;
  }
  pass(PassKind::kColour, views_a_pass_);
  if (!images.depth_chains.empty()) {
    pass(PassKind::kDepth, views_a_pass_);
  }
}

/// One that is copied into, for shaders to read; a layer for each view.
DeviceImage Canvas::sampled_image(VkFormat format) const {
  ImageSpec spec;
  spec.format = format;
  spec.width = static_cast<std::uint32_t>(images_.width_px);
  spec.height = static_cast<std::uint32_t>(images_.height_px);
  spec.layers = kMaxViews;
  spec.usage = VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
  return {drawing_.device(), spec};
}

const FramePass& Canvas::pass(PassKind kind, std::size_t views) {
  auto& pass = passes_[kMaxViews * static_cast<std::size_t>(kind) + views - 1];
  if (!pass) {
    TargetSpec spec;
    spec.kind = kind;
    spec.width = static_cast<std::uint32_t>(images_.width_px);
    spec.height = static_cast<std::uint32_t>(images_.height_px);
    spec.views = static_cast<std::uint32_t>(views);
    spec.edges = look_.edges;
    if (!own()) {
      spec.colour = static_cast<VkFormat>(images_.format);
      spec.depth = static_cast<VkFormat>(images_.depth_format);
      spec.outer = outer_images(kind == PassKind::kDepth ? images_.depth_chains : images_.chains);
      spec.outer_layers = images_.layers;
    }
    pass = std::make_unique<FramePass>(drawing_.device(), drawing_.cache(),
                                       slots_.front()->bindings.layout(), spec, look_.blend);
    pass->clear_alpha = look_.clear_alpha;
  }
  return *pass;
}

bool Canvas::holds(std::span<const std::uint32_t> indices) const {
  const std::size_t chains = images_.chains.size();
  if (indices.size() != chains + images_.depth_chains.size()) {
    return false;
  }
  for (std::size_t i = 0; i < indices.size(); ++i) {
    const auto& chain = i < chains ? images_.chains[i] : images_.depth_chains[i - chains];
    if (indices[i] >= chain.size()) {
      return false;
    }
  }
  return true;
}

void Canvas::wait() {
  now_ = (now_ + 1) % slots_.size();
  slots_[now_]->commands.wait();
}

void Canvas::wait_for_all() {
  for (const auto& slot : slots_) {
    slot->commands.wait();
  }
}

/// Uploads the parts of them that shaders will read, for the pass whose first view is `first`.
void Canvas::upload_backgrounds(VkCommandBuffer batch,
                                std::span<const RgbaImage* const> backgrounds, std::size_t first) {
  if (background_staging_.size() == 0) {
    background_staging_ = Buffer(drawing_.device(), kMaxViews * image_bytes(),
                                 VK_BUFFER_USAGE_TRANSFER_SRC_BIT, BufferPlace::kUpload);
    background_ = sampled_image(kColourFormat);
    slots_[now_]->bindings.bind_background(background_);
  }
  for (std::size_t i = 0; i < backgrounds.size(); ++i) {
    for (const PixelRect& region : drawing_.items().regions()) {
      for (int y = region.top; y < region.bottom; ++y) {
        const std::size_t at = 4 * (static_cast<std::size_t>(y) * images_.width_px + region.left);
        background_staging_.write(&backgrounds[i]->pixels[at],
                                  4 * static_cast<std::size_t>(region.width()),
                                  (first + i) * image_bytes() + at);
      }
    }
  }
  const VkExtent2D extent = {static_cast<std::uint32_t>(images_.width_px),
                             static_cast<std::uint32_t>(images_.height_px)};
  fill_image(batch,
             {background_staging_, background_, extent, 4,
              static_cast<std::uint32_t>(backgrounds.size()), kMaxViews, first * image_bytes()},
             drawing_.items().regions());
}

void Canvas::submit(PassKind kind, const Frame& frame, DrawnViews drawn,
                    std::span<const std::uint32_t> indices) {
  FrameSlot& slot = *slots_[now_];
  drawing_.build(frame, size(), kind, drawn, slot);
  const VkCommandBuffer batch = slot.commands.begin();
  const std::size_t end = drawn.first + drawn.count;
  for (std::size_t first = drawn.first; first < end;) {
    const std::size_t count = std::min(end - first, views_a_pass_);
    drawing_.place(std::span(frame.views).subspan(first, count), first, size(), slot);
    for (std::size_t view = first; view < first + count; ++view) {
      regions_[view] = drawing_.items().regions();
    }
    if (!frame.backgrounds.empty()) {
      upload_backgrounds(batch, frame.backgrounds.subspan(first, count), first);
    }
    const auto draw = [&](const FramePass& pass, std::size_t outer) {
      record_frame(
          batch,
          {pass, slot.bindings, drawing_.meshes(), drawing_.items(), slot.line_indices, readback_,
           first * image_bytes(), static_cast<std::uint32_t>(first * kFrameStride),
           !frame.backgrounds.empty(), outer, drawing_.edges(first), drawn_so_far_.get()});
    };
    // Image `indices[chain]` of the eye's own chain, or the eye's layer of it in a shared chain.
    const auto outer_of = [&](const auto& chains, std::size_t first_index) {
      const std::size_t chain = chains.size() == 1 ? 0 : first;
      const std::size_t image = chain * chains.front().size() + indices[first_index + chain];
      const std::size_t passes = images_.layers / count;
      return image * passes + (passes > 1 ? first : 0);
    };
    draw(pass(kind, count), own() ? 0 : outer_of(images_.chains, 0));
    if (!images_.depth_chains.empty()) {
      draw(pass(PassKind::kDepth, count), outer_of(images_.depth_chains, images_.chains.size()));
    }
    first += count;
  }
  slot.commands.submit();
}

}  // namespace orthonav::render
