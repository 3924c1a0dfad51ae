#include "engine/live/display_renderer.h"

#include <utility>

#include "engine/holograms/render_values.h"
#include "engine/holograms/scene_builder.h"
#include "render/projection.h"

namespace orthonav::engine {
namespace {

/// Passes on what the renderer asks of its host.
class Host : public render::VulkanHost {
 public:
  Host(PixelDisplay& display, const GraphicsNeeds& needs) : display_(display), needs_(needs) {}
  [[nodiscard]] std::array<render::VulkanVersion, 2> versions() const override {
    const auto& [least, most] = needs_.vulkan;
    return {render::VulkanVersion{least.major, least.minor},
            render::VulkanVersion{most.major, most.minor}};
  }
  void* create_instance(render::VulkanFunction get, const void* info, std::string& error) override {
    return made(display_.create_instance(get, info), error);
  }
  void* physical_device(void* instance, std::string& error) override {
    return made(display_.physical_device(instance), error);
  }
  void* create_device(void* physical, render::VulkanFunction get, const void* info,
                      std::string& error) override {
    return made(display_.create_device(physical, get, info), error);
  }

 private:
  static void* made(Result<void*> answer, std::string& error) {
    if (!answer) {
      return error = answer.error().message, nullptr;
    }
    return *answer;
  }

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

GraphicsObjects objects_of(const render::VulkanObjects& objects) {
  return {objects.instance, objects.physical, objects.device, objects.queue_family,
          objects.queue_index};
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
  std::string error;
  std::unique_ptr<DisplayRenderer> made(new DisplayRenderer(display));
  made->renderer_ = render::HostedRenderer::create(options, host, error);
  if (!made->renderer_) {
    return Error{error};
  }
  const auto images =
      display.start(objects_of(made->renderer_->objects()), Preference(*made->renderer_));
  if (!images) {
    return images.error();
  }
  const render::EyeTargets targets = {images->format,      images->width_px, images->height_px,
                                      images->layers,      images->chains,   images->depth_format,
                                      images->depth_chains};
  if (!made->renderer_->use(targets, error)) {
    return Error{error};
  }
  return made;
}

DisplayRenderer::~DisplayRenderer() {
  // A device that is lost has no frames in flight; there is nobody to be told.
  std::string ignored;
  if (renderer_) {
    static_cast<void>(renderer_->finish(ignored));
  }
  display_.close();
}

Result<bool> DisplayRenderer::draw(const render::Scene& scene) {
  const auto images = display_.acquire();
  if (!images) {
    return images.error();
  }
  std::string error;
  if (!renderer_->prepare(scene, error)) {
    return Error{error};
  }
  const EyeViews eyes = display_.views();
  drawn_ = &scene;
  if (eyes.status == PoseStatus::kLost) {
    if (!eyes.on_head) {
      return false;
    }
    write_head_lost(scene, left_);
    if (!renderer_->prepare(left_, error)) {
      return Error{error};
    }
    drawn_ = &left_;
  }
  views_.clear();
  for (const EyeView& eye : eyes.value) {
    views_.push_back(view_of(eye));
  }
  if (!renderer_->draw(*drawn_, views_, *images, error)) {
    return Error{error};
  }
  return true;
}

}  // namespace orthonav::engine
