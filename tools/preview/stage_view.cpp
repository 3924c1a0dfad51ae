#include "tools/preview/stage_view.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/stopwatch.h"
#include "engine/holograms/shapes/render_values.h"
#include "tools/preview/outlines.h"
#include "tools/support/eye_in_rig.h"

namespace orthonav::preview {
namespace {

/// The background where nothing is known: a dark grey on which every hologram is legible.
constexpr std::array<std::uint8_t, 4> kEmpty = {34, 37, 42, 255};

}  // namespace

Result<std::unique_ptr<StageView>> StageView::create(const StageOptions& options) {
  render::RendererOptions renderer_options;
  renderer_options.width_px = options.width_px;
  renderer_options.height_px = options.height_px;
  renderer_options.blend = render::Blend::kOver;
  renderer_options.device = options.device;
  auto renderer = render::Renderer::create(renderer_options);
  if (!renderer) {
    return renderer.error();
  }
  return std::unique_ptr<StageView>(new StageView(options, std::move(*renderer)));
}

StageView::StageView(const StageOptions& options, std::unique_ptr<render::Renderer> renderer)
    : options_(options), renderer_(std::move(renderer)), views_(1), images_(1) {
  room_picture_.width_px = background_.width_px = options.width_px;
  room_picture_.height_px = background_.height_px = options.height_px;
  const std::size_t bytes =
      4u * static_cast<std::size_t>(options.width_px) * static_cast<std::size_t>(options.height_px);
  room_picture_.pixels.resize(bytes);
  background_.pixels.resize(bytes);
  images_[0] = background_;
  backgrounds_.assign(1, &background_);
}

void StageView::look_at_room(const sim::SimHeadset& headset) {
  room_ = sim::RoomRenderer::create(headset.room(), headset.options().error_model);
  recording_.reset();
}

void StageView::look_at_recording(RecordedImages images) {
  room_.reset();
  recording_.emplace(std::move(images));
}

Transform<sim::Room, Eye> StageView::eye_of(const Moment& moment) const {
  if (moment.room) {
    return moment.room->room_from_rig * tools::rig_from_eye();
  }
  // Without a room the stage is the map itself, and the eye is the camera whose image is the
  // background.
  const Transform<sim::Room, World> stage_from_world;
  const Vec3 eye = recording_ ? recording_->eye_in_rig() : Vec3{};
  return stage_from_world * moment.world_from_rig.value *
         Transform<Rig, Eye>{Mat3::identity(), eye};
}

void StageView::set_field_of_view(double magnification) {
  const double tan_side =
      std::tan(options_.half_angle_deg * std::numbers::pi / 180.0) / magnification;
  const double tan_up = tan_side * options_.height_px / options_.width_px;
  views_[0].tan_left = views_[0].tan_right = static_cast<float>(tan_side);
  views_[0].tan_up = views_[0].tan_down = static_cast<float>(tan_up);
}

void StageView::draw_background(const Moment& moment, const Look& look,
                                const Transform<sim::Room, Eye>& stage_from_eye) {
  const Stopwatch watch;
  const render::View& view = views_[0];
  if (room_ && moment.room) {
    const sim::PinholeView seen{
        stage_from_eye, static_cast<double>(view.tan_left), static_cast<double>(view.tan_right),
        static_cast<double>(view.tan_up), static_cast<double>(view.tan_down)};
    room_->picture(*moment.room, seen, room_picture_);
    background_.pixels.swap(room_picture_.pixels);
    combiner_.dim(background_);
  } else {
    for (std::size_t i = 0; i < background_.pixels.size(); i += 4) {
      std::copy(kEmpty.begin(), kEmpty.end(), background_.pixels.begin() + static_cast<long>(i));
    }
    if (recording_ && !look.camera.orbits()) {
      recording_->draw(moment.sequence, view, background_);
      combiner_.dim(background_);
    }
  }
  background_ms_ = watch.elapsed_ms();
}

Status StageView::draw(const Moment& moment, const Look& look) {
  set_field_of_view(look.camera.magnification());
  const auto stage_from_eye = look.camera.orbits() ? look.camera.stage_from_eye() : eye_of(moment);
  draw_background(moment, look, stage_from_eye);
  // A headset that does not know where it is shows nothing.
  scene_ = {};
  if (moment.world_from_rig.status != PoseStatus::kLost) {
    look.holograms.apply(moment.scene, scene_);
    // Without a picture, nothing else shows where things are.
    const bool no_picture = !moment.room && look.camera.orbits();
    if (look.tools || no_picture) {
      add_outlines(moment, look.camera.orbits(), scene_);
    }
    // Holograms are where the headset draws them relative to the true head.
    Transform<sim::Room, World> stage_from_world;
    if (moment.room) {
      stage_from_world = moment.room->room_from_rig * moment.world_from_rig.value.inverse();
    }
    const auto eye_from_world = stage_from_eye.inverse() * stage_from_world;
    views_[0].eye_from_world = engine::to_matrix(eye_from_world.row_major());
  }
  return renderer_->draw(scene_, views_, backgrounds_, images_);
}

}  // namespace orthonav::preview
