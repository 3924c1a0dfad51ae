#include "render/frame/scene_check.h"
#include "render/vulkan/eye_images.h"
#include "render/vulkan/hosted_vulkan_renderer.h"

// The panel that the host lays over the eyes' images.

namespace orthonav::render {

void HostedVulkanRenderer::make_panel_pass() {
  TargetSpec spec;
  spec.width = static_cast<std::uint32_t>(images_.panel.width_px);
  spec.height = static_cast<std::uint32_t>(images_.panel.height_px);
  spec.edges = Edges::kHard;  // texts need nothing else
  spec.colour = static_cast<VkFormat>(images_.format);
  spec.outer = outer_images({images_.panel.chain});
  // Additive blending does not write alpha, which stays 0 as it was cleared.
  const Blend blend = options_.blend == Blend::kAdditive ? Blend::kAdditive : Blend::kPremultiplied;
  panel_pass_ =
      std::make_unique<FramePass>(device_, drawing_.cache(), drawing_.layout(), spec, blend);
  panel_pass_->clear_alpha = 0.0f;
}

void HostedVulkanRenderer::record_panel(const View& view, std::uint32_t index) {
  const FrameSlot& slot = drawing_.slot();
  drawing_.place({&view, 1}, 0, {images_.panel.width_px, images_.panel.height_px});
  const Buffer nobody_reads;
  record_outer_frame(drawing_.slot().commands.begin(),
                     {*panel_pass_, slot.bindings, drawing_.meshes(), drawing_.items(),
                      slot.line_indices, nobody_reads, 0, 0, false, index});
}

Status HostedVulkanRenderer::draw_panel(const Scene& scene, const View& view, std::uint32_t index) {
  return attempt([&]() -> Status {
    panel_view_.assign(1, view);
    if (const Status checked = check_views(panel_view_); !checked) {
      return checked;
    }
    if (!panel_pass_ || index >= images_.panel.chain.size()) {
      return Error{"renderer: no such image of the host's panel"};
    }
    if (!scene.meshes.empty() || !scene.lines.empty() || !scene.triangles.empty()) {
      return Error{"renderer: a panel may hold text only"};
    }
    return drawing_.aside([&]() -> Status {
      if (const Status taken = drawing_.take(scene); !taken) {
        return taken;
      }
      drawing_.build(scene, panel_view_, {images_.panel.width_px, images_.panel.height_px},
                     PassKind::kColour, {0, 1});
      record_panel(view, index);
      drawing_.slot().commands.submit();
      return {};
    });
  });
}

}  // namespace orthonav::render
