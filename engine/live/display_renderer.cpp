#include "engine/live/display_renderer.h"

#include <utility>

#include "engine/holograms/scene_builder.h"
#include "engine/holograms/shapes/render_values.h"
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
  explicit Preference(const render::Renderer& renderer) : renderer_(renderer) {}
  [[nodiscard]] int format_score(std::int64_t format) const override {
    return renderer_.format_score(format);
  }
  [[nodiscard]] int depth_format_score(std::int64_t format) const override {
    return renderer_.depth_format_score(format);
  }
  [[nodiscard]] double near_m() const override { return static_cast<double>(render::kNearPlane_m); }
  [[nodiscard]] std::array<int, 2> panel_px() const override { return kStatusPanel_px; }

 private:
  const render::Renderer& renderer_;
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
  auto renderer = render::Renderer::create(options, host);
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
  made->panel_.emplace(display, *made->renderer_, !images->panel.chain.empty());
  return made;
}

DisplayRenderer::~DisplayRenderer() {
  if (renderer_) {
    // A lost device has no frames in flight, and the error can no longer be reported.
    static_cast<void>(renderer_->finish());
  }
  display_.close();
}

Status DisplayRenderer::draw_eyes(const EyeViews& eyes, std::span<const std::uint32_t> images) {
  views_.clear();
  for (const EyeView& eye : eyes.value) {
    views_.push_back(view_of(eye));
  }
  return renderer_->draw(*drawn_, views_, images,
                         panel_shows_ ? render::HeadTexts::kLeftOut : render::HeadTexts::kDrawn);
}

Result<bool> DisplayRenderer::draw(const render::Scene& scene) {
  const bool was_located = drawn_ != &head_lost_;
  eyes_drawn_ = false;
  // A head that was located probably still is: then the panel is done before the eyes are located.
  panel_shows_ = was_located && panel_->show(scene);
  const auto images = display_.acquire();
  if (!images) {
    return images.error();
  }
  if (const Status prepared = renderer_->prepare(scene); !prepared) {
    return prepared.error();
  }
  const EyeViews eyes = display_.views();
  gaze_ = eyes.gaze;
  drawn_ = &scene;
  if (eyes.status == PoseStatus::kLost) {
    write_head_lost(scene, head_lost_);
    drawn_ = &head_lost_;
    panel_shows_ = panel_->show(head_lost_);
    if (!eyes.on_head) {
      return false;
    }
    if (const Status prepared = renderer_->prepare(head_lost_); !prepared) {
      return prepared.error();
    }
  } else if (!was_located) {
    panel_shows_ = panel_->show(scene);
  }
  if (const Status drawn = draw_eyes(eyes, *images); !drawn) {
    return drawn.error();
  }
  return eyes_drawn_ = true;
}

Status DisplayRenderer::end_frame() {
  const Status ended = display_.end_frame({eyes_drawn_, panel_->shown()});
  eyes_drawn_ = false;
  panel_->ended(ended.ok());
  return ended;
}

}  // namespace orthonav::engine
