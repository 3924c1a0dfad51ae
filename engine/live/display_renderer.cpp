#include "engine/live/display_renderer.h"

#include <utility>

#include "engine/holograms/render_values.h"
#include "engine/holograms/scene_builder.h"
#include "render/projection.h"

namespace orthonav::engine {
namespace {

/// Forwards the renderer's calls to its host.
class Host : public render::VulkanHost {
 public:
  Host(PixelDisplay& display, const GraphicsNeeds& needs) : display_(display), needs_(needs) {}
  [[nodiscard]] std::array<VulkanVersion, 2> versions() const override { return needs_.vulkan; }
  Result<void*> create_instance(VulkanFunction get, const void* info) override {
    return display_.create_instance(get, info);
  }
  Result<void*> physical_device(void* instance) override {
    return display_.physical_device(instance);
  }
  Result<void*> create_device(void* physical, VulkanFunction get, const void* info) override {
    return display_.create_device(physical, get, info);
  }

 private:
  PixelDisplay& display_;
  GraphicsNeeds needs_;
};

class Preference : public FormatPreference {
 public:
  explicit Preference(const render::HostedRenderer& renderer) : renderer_(renderer) {}
  [[nodiscard]] int format_score(std::int64_t format) const override {
    return renderer_.format_score(format);
  }
  [[nodiscard]] int depth_format_score(std::int64_t format) const override {
    return renderer_.depth_format_score(format);
  }
  [[nodiscard]] double near_m() const override { return static_cast<double>(render::kNearPlane_m); }
  [[nodiscard]] bool takes_layers() const override { return renderer_.takes_layers(); }

 private:
  const render::HostedRenderer& renderer_;
};

render::Blend blend_for(WorldBlend blend) {
  if (blend == WorldBlend::kAdditive) {
    return render::Blend::kAdditive;
  }
  return blend == WorldBlend::kAlpha ? render::Blend::kPremultiplied : render::Blend::kOver;
}

render::View view_of(const EyeView& eye) {
  render::View view;
  view.eye_from_world = to_matrix(eye.world_from_eye.inverse().row_major());
  view.tan_left = static_cast<float>(eye.tan_left);
  view.tan_right = static_cast<float>(eye.tan_right);
  view.tan_up = static_cast<float>(eye.tan_up);
  view.tan_down = static_cast<float>(eye.tan_down);
  return view;
}

}  // namespace

Result<std::unique_ptr<DisplayRenderer>> DisplayRenderer::start(PixelDisplay& display,
                                                                render::RendererOptions options) {
  const auto needs = display.open();
  if (!needs) {
    return needs.error();
  }
  options.blend = blend_for(needs->blend);
  Host host(display, *needs);
  std::unique_ptr<DisplayRenderer> made(new DisplayRenderer(display));
  auto renderer = render::HostedRenderer::create(options, host);
  if (!renderer) {
    return renderer.error();
  }
  made->renderer_ = std::move(*renderer);
  const auto images = display.start(made->renderer_->objects(), Preference(*made->renderer_));
  if (!images) {
    return images.error();
  }
  if (const Status used = made->renderer_->use(*images); !used) {
    return used.error();
  }
  return made;
}

DisplayRenderer::~DisplayRenderer() {
  if (renderer_) {
    // A lost device has no frames in flight, and the error can no longer be reported.
    static_cast<void>(renderer_->finish());
  }
  display_.close();
}

Result<bool> DisplayRenderer::draw(const render::Scene& scene) {
  const auto images = display_.acquire();
  if (!images) {
    return images.error();
  }
  if (const Status prepared = renderer_->prepare(scene); !prepared) {
    return prepared.error();
  }
  const EyeViews eyes = display_.views();
  drawn_ = &scene;
  if (eyes.status == PoseStatus::kLost) {
    if (!eyes.on_head) {
      return false;
    }
    write_head_lost(scene, head_lost_);
    if (const Status prepared = renderer_->prepare(head_lost_); !prepared) {
      return prepared.error();
    }
    drawn_ = &head_lost_;
  }
  views_.clear();
  for (const EyeView& eye : eyes.value) {
    views_.push_back(view_of(eye));
  }
  if (const Status drawn = renderer_->draw(*drawn_, views_, *images); !drawn) {
    return drawn.error();
  }
  return true;
}

}  // namespace orthonav::engine
