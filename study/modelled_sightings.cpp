#include "study/modelled_sightings.h"

#include <algorithm>
#include <cmath>

#include "hal/sim/room/tag_flaws.h"

namespace orthonav::engine {
namespace {

template <class CameraFrame>
std::optional<nav::TagCorners> exact_corners(const CameraModel& camera,
                                             const Transform<CameraFrame, Rig>& camera_from_rig,
                                             const Transform<Rig, Marker>& rig_from_marker,
                                             double size_m, const sim::TagFlaws& flaws,
                                             const MeasurementModel& model) {
  const auto camera_from_marker = camera_from_rig * rig_from_marker;
  const Vec3 away = camera_from_marker.translation();
  const Vec3 face = camera_from_marker.rotation() * Vec3{0, 0, 1};
  if (!(-face.dot(away) > model.least_facing * away.norm())) {
    return std::nullopt;
  }
  nav::TagCorners corners;
  const auto in_marker_m = nav::corners_in_marker(size_m);
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vec3 flat_m = in_marker_m[k];
    const Vec3 bent_m = flat_m + sim::height_m(flaws, size_m, {flat_m.x, flat_m.y}) * Vec3{0, 0, 1};
    const auto seen = camera.project((camera_from_marker * Point<Marker>{bent_m}).v);
    if (!seen) {
      return std::nullopt;
    }
    corners[k] = *seen;
  }
  const double diagonal_px =
      std::min((corners[0] - corners[2]).norm(), (corners[1] - corners[3]).norm());
  return diagonal_px < model.least_px ? std::nullopt : std::optional(corners);
}

template <class CameraFrame>
void look_from(const Transform<CameraFrame, Rig>& camera_from_rig, const sim::RoomState& now,
               sim::TagOcclusion& occlusion) {
  const auto camera_from_room = camera_from_rig * now.room_from_rig.inverse();
  occlusion.look(now, {camera_from_room.rotation(), camera_from_room.translation()});
}

}  // namespace

ModelledSightings::ModelledSightings(const sim::SimHeadset& room, const MeasurementModel& model)
    : room_(&room),
      model_(model),
      random_(Random(room.options().seed).fork("measurement model")),
      left_(room.room()),
      right_(room.room()),
      trails_(room.room().tools.size()),
      seen_(room.room().tools.size()),
      near_(room.room().tools.size()) {}

void ModelledSightings::look(const StereoFrame& frame) {
  const sim::RoomState now = room_->state();
  const StereoCalibration& cameras = room_->actual_calibration();
  look_from(cameras.left_from_rig, now, left_);
  look_from(cameras.right_from_rig, now, right_);
  for (std::size_t i = 0; i < seen_.size(); ++i) {
    look_at(i, frame, now);
  }
  before_ = frame.time;
}

void ModelledSightings::look_at(std::size_t tool, const StereoFrame& frame,
                                const sim::RoomState& now) {
  StereoCorners& seen = seen_[tool];
  Trail& trail = trails_[tool];
  seen = {};
  if (!now.tool_present[tool]) {
    trail = {};
    return;
  }
  const StereoCalibration& cameras = room_->actual_calibration();
  near_[tool] = now.room_from_rig.inverse() * now.room_from_marker[tool];
  const double size_m = room_->room().tools[tool].size_m;
  Random random = random_.fork(static_cast<std::uint64_t>(frame.sequence)).fork(tool);
  const double dt_s = seconds(frame.time - before_);
  const sim::TagFlaws& flaws = room_->room().tag_flaws[tool];
  const bool covered = sim::covers_a_corner(flaws, size_m);
  if (is_blinded(tool, now) || (covered && model_.drop_hides)) {
    trail = {};
    return;
  }
  const double worse = covered ? model_.drop_factor : 1.0;
  const auto exact = [&](const auto& camera, const auto& camera_from_rig,
                         const sim::TagOcclusion& occlusion) {
    return occlusion.hides(tool)
               ? std::nullopt
               : exact_corners(camera, camera_from_rig, near_[tool], size_m, flaws, model_);
  };
  seen.left_px = with_errors(exact(cameras.left, cameras.left_from_rig, left_),
                             trail.lasting.left_px, trail.before_left, random, dt_s, worse);
  seen.right_px = with_errors(exact(cameras.right, cameras.right_from_rig, right_),
                              trail.lasting.right_px, trail.before_right, random, dt_s, worse);
}

bool ModelledSightings::is_blinded(std::size_t tool, const sim::RoomState& now) const {
  const auto& room_from_marker = now.room_from_marker[tool];
  const Vec3 to_viewer =
      (now.room_from_rig.translation() - room_from_marker.translation()).normalized();
  return sim::glare(room_->options().error_model.tag_gloss, room_from_marker.rotation().column(2),
                    sim::lamp_in_room(), to_viewer) > model_.most_glare;
}

std::optional<nav::TagCorners> ModelledSightings::with_errors(
    const std::optional<nav::TagCorners>& exact, nav::TagCorners& lasting,
    std::optional<nav::TagCorners>& before, Random& random, double dt_s, double worse) const {
  if (!exact) {
    before.reset();
    return std::nullopt;
  }
  const double kept = before ? std::exp(-dt_s / model_.lasts_s) : 0.0;
  const double fresh_px = worse * model_.lasting_px * std::sqrt(1.0 - kept * kept);
  const double exposed = dt_s > 0.0 ? room_->options().error_model.exposure_s / dt_s : 0.0;
  nav::TagCorners corners = *exact;
  double blur_px = 0.0;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vec2 moved_px = before ? exposed * ((*exact)[k] - (*before)[k]) : Vec2{};
    blur_px = std::max(blur_px, moved_px.norm());
    const double x = random.normal();
    const double y = random.normal();
    lasting[k] = kept * lasting[k] + fresh_px * Vec2{x, y};
    const double u = random.normal();
    const double v = random.normal();
    const double along = random.normal();
    corners[k] = corners[k] + lasting[k] + worse * model_.white_px * Vec2{u, v} +
                 model_.of_blur * along * moved_px;
  }
  before = exact;
  return blur_px > model_.most_blur_px ? std::nullopt : std::optional(corners);
}

std::optional<Transform<Rig, Marker>> ModelledSightings::near(std::size_t tool) const {
  const StereoCorners& seen = seen_[tool];
  return seen.left_px || seen.right_px ? std::optional(near_[tool]) : std::nullopt;
}

}  // namespace orthonav::engine
