#include "bench/other_view.h"

#include <cmath>

namespace orthonav::bench {
namespace {

/// Light and distances are specified for this place.
constexpr Vec3 kMiddle{0.0, 0.0, -0.5};
/// A slanting board behind the tools.
constexpr Vec3 kBoardPoint{0.0, 0.0, -1.05};
constexpr Vec3 kBoardNormal{0.12, 0.2, 0.97};
constexpr double kBoardSideM = 1.2;
constexpr float kPaper = 0.85F;
constexpr float kInk = 0.035F;
constexpr float kSkin = 0.4F;

}  // namespace

OtherView::OtherView(const Moment& moment, const Transform<LeftCamera, Rig>& camera_from_rig,
                     std::span<const DrawnTag> tags, const Lighting& lighting,
                     const Clutter& clutter)
    : lighting_(lighting), clutter_(clutter), finger_(moment.finger) {
  const auto world_from_camera = moment.world_from_rig * camera_from_rig.inverse();
  world_from_camera_ = world_from_camera.rotation();
  eye_ = world_from_camera.translation();
  for (std::size_t i = 0; i < tags.size(); ++i) {
    const auto marker_from_world = moment.world_from_marker[i].inverse();
    const auto marker_from_camera = marker_from_world * world_from_camera;
    tags_.push_back({&tags[i], marker_from_camera.rotation(), marker_from_camera.translation(),
                     (marker_from_world * lighting.lamp).v,
                     tags[i].print.size_m * (0.5 + tags[i].print.margin_cells / 8.0)});
  }
}

float OtherView::tag_light(const TagSeen& seen, double x, double y) const {
  const double size = seen.tag->print.size_m;
  const double column = (x / size + 0.5) * 8.0;
  const double row = (0.5 - y / size) * 8.0;
  bool white = true;
  if (column >= 0.0 && column < 8.0 && row >= 0.0 && row < 8.0) {
    white =
        seen.tag
            ->white[static_cast<std::size_t>(static_cast<int>(row) * 8 + static_cast<int>(column))];
  }
  const Vec3 to_lamp = seen.lamp - Vec3{x, y, 0.0};
  const double r2 = to_lamp.squared_norm();
  const double reference = (lighting_.lamp.v - kMiddle).squared_norm();
  const double lamp = std::max(to_lamp.z, 0.0) / std::sqrt(r2) * reference / r2;
  double light = (white ? kPaper : kInk) * (lighting_.ambient + (1.0 - lighting_.ambient) * lamp);
  if (lighting_.highlight > 0.0) {
    const Vec3 to_eye = seen.eye - Vec3{x, y, 0.0};
    const Vec3 half = to_lamp / std::sqrt(r2) + to_eye.normalized();
    const double tangent2 = (half.x * half.x + half.y * half.y) / (half.z * half.z);
    light += lighting_.highlight *
             std::exp(-0.5 * tangent2 / (lighting_.gloss_rad * lighting_.gloss_rad));
  }
  return static_cast<float>(lighting_.exposure * light);
}

std::optional<double> OtherView::finger_depth(Vec2 ray) const {
  if (!finger_) {
    return std::nullopt;
  }
  // The points of ray and axis nearest to each other.
  const Vec3 d = world_from_camera_ * Vec3{ray.x, ray.y, 1.0};
  const Vec3 axis = finger_->to - finger_->from;
  const Vec3 w = eye_ - finger_->from.v;
  const double a = d.dot(d), b = d.dot(axis), c = axis.dot(axis);
  const double det = a * c - b * b;
  double t = det > 1e-12 ? (a * axis.dot(w) - b * d.dot(w)) / det : 0.0;
  t = std::clamp(t, 0.0, 1.0);
  const Vec3 on_axis = finger_->from.v + t * axis;
  const double s = d.dot(on_axis - eye_) / a;
  const double gap = (eye_ + s * d - on_axis).norm();
  if (s <= 0.0 || gap >= finger_->radius_m) {
    return std::nullopt;
  }
  return gap / finger_->radius_m;
}

float OtherView::light_behind_tags(Vec2 ray) const {
  if (const auto off = finger_depth(ray)) {
    return static_cast<float>(lighting_.exposure * static_cast<double>(kSkin) *
                              (0.3 + 0.7 * std::sqrt(1.0 - *off * *off)));
  }
  const Vec3 d = world_from_camera_ * Vec3{ray.x, ray.y, 1.0};
  const double along = kBoardNormal.dot(kBoardPoint - eye_) / kBoardNormal.dot(d);
  if (!(along > 0.0)) {
    return 0.0F;
  }
  const Vec3 p = eye_ + along * d;
  return static_cast<float>(0.8 * lighting_.exposure) *
         clutter_.at(p.x / kBoardSideM + 0.4, p.y / kBoardSideM + 0.3);
}

float OtherView::light(Vec2 ray) const {
  if (finger_ && is_behind_finger(ray)) {
    return light_behind_tags(ray);
  }
  double nearest = 1e9;
  float found = 0.0F;
  for (const TagSeen& seen : tags_) {
    const Vec3 d = seen.marker_from_camera * Vec3{ray.x, ray.y, 1.0};
    const double along = -seen.eye.z / d.z;
    if (!(along > 0.0) || along > nearest || seen.eye.z < 0.0) {
      continue;
    }
    const double x = seen.eye.x + along * d.x;
    const double y = seen.eye.y + along * d.y;
    if (std::abs(x) > seen.half_paper_m || std::abs(y) > seen.half_paper_m) {
      continue;
    }
    nearest = along;
    found = tag_light(seen, x, y);
  }
  return nearest < 1e9 ? found : light_behind_tags(ray);
}

double OtherView::cosine(std::size_t tag, Vec3 in_marker_m) const {
  return (tags_[tag].eye - in_marker_m).normalized().z;
}

}  // namespace orthonav::bench
