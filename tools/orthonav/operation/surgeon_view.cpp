#include "tools/orthonav/operation/surgeon_view.h"

#include <cmath>
#include <cstdio>
#include <numbers>

#include "engine/holograms/scene_builder.h"
#include "engine/holograms/shapes/render_values.h"
#include "tools/support/eye_in_rig.h"

namespace orthonav::tools {
Result<std::unique_ptr<SurgeonView>> SurgeonView::create(const SurgeonViewOptions& options) {
  render::RendererOptions renderer_options;
  renderer_options.width_px = options.width_px;
  renderer_options.height_px = options.height_px;
  renderer_options.blend = render::Blend::kAdditive;
  renderer_options.device = options.device;
  auto renderer = render::Renderer::create(renderer_options);
  if (!renderer) {
    return renderer.error();
  }
  return std::unique_ptr<SurgeonView>(new SurgeonView(options, std::move(*renderer)));
}

SurgeonView::SurgeonView(const SurgeonViewOptions& options,
                         std::unique_ptr<render::Renderer> renderer)
    : options_(options), renderer_(std::move(renderer)) {
  room_picture_.width_px = background_.width_px = options.width_px;
  room_picture_.height_px = background_.height_px = options.height_px;
  room_picture_.pixels.resize(4u * static_cast<std::size_t>(options.width_px) *
                              static_cast<std::size_t>(options.height_px));
  const double tan_side = std::tan(options.half_angle_deg * std::numbers::pi / 180.0);
  const double tan_up = tan_side * options.height_px / options.width_px;
  render::View view;
  view.tan_left = view.tan_right = static_cast<float>(tan_side);
  view.tan_up = view.tan_down = static_cast<float>(tan_up);
  views_.push_back(view);
}

void SurgeonView::look_at(sim::SimHeadset& headset, const sim::ErrorModel& error_model) {
  headset_ = &headset;
  room_ = sim::RoomRenderer::create(headset.room(), error_model);
}

void SurgeonView::captured(const engine::Snapshot& snapshot) {
  Moment& moment = moments_[snapshot.slot];
  moment.room = headset_->state();
  // At the time of the room's state, so that the bone and holograms fixed to it coincide. Holograms
  // that follow the tool are predicted to the display time, some 30 ms ahead of the room behind
  // them.
  moment.world_from_rig = headset_->head().world_from_rig(moment.room.time);
}

void SurgeonView::draw_room(const Moment& moment) {
  sim::PinholeView view;
  view.room_from_eye = moment.room.room_from_rig * rig_from_eye();
  view.tan_left = static_cast<double>(views_[0].tan_left);
  view.tan_right = static_cast<double>(views_[0].tan_right);
  view.tan_up = static_cast<double>(views_[0].tan_up);
  view.tan_down = static_cast<double>(views_[0].tan_down);
  view.hand_opacity = options_.hand_opacity;
  room_->picture(moment.room, view, room_picture_);
  background_.pixels.swap(room_picture_.pixels);
  combiner_.dim(background_);
}

Status SurgeonView::draw(const engine::Snapshot& snapshot) {
  const Moment& moment = moments_[snapshot.slot];
  draw_room(moment);
  const bool located = moment.world_from_rig.status != PoseStatus::kLost;
  if (located) {
    const auto eye_from_world = (moment.world_from_rig.value * rig_from_eye()).inverse();
    views_[0].eye_from_world = engine::to_matrix(eye_from_world.row_major());
  }
  backgrounds_.assign(1, &background_);
  if (located) {
    drawn_ = snapshot.scene;
    labels_.lay_out(drawn_, views_, snapshot.patches, snapshot.display_time);
  } else {
    engine::write_head_lost(snapshot.scene, drawn_);
  }
  const Status drawn = renderer_->draw(drawn_, views_, backgrounds_, images_);
  background_.pixels.swap(room_picture_.pixels);
  if (!drawn) {
    return drawn;
  }
  hand_out(snapshot);
  return {};
}

void SurgeonView::hand_out(const engine::Snapshot& snapshot) {
  std::erase_if(sinks_, [&](PictureSink* sink) {
    const Status taken = sink->picture(images_[0], snapshot);
    if (!taken) {
      std::fprintf(stderr, "orthonav: %s; the operation goes on without\n",
                   taken.error().message.c_str());
    }
    return !taken.ok();
  });
}

}  // namespace orthonav::tools
