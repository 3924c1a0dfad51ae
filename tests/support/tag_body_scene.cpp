#include "tests/support/tag_body_scene.h"

#include <cmath>

namespace orthonav::test {
namespace {

constexpr double kSteepestCosine = 0.26;  // 75°
constexpr double kMarginPx = 3.0;

template <class Camera>
std::optional<nav::TagCorners> corners_in(const CameraModel& model,
                                          const Transform<Camera, Rig>& camera_from_rig,
                                          const Transform<Rig, Tag>& rig_from_tag, double size_m,
                                          double noise_px, Random& random) {
  const Vec3 to_tag = (camera_from_rig * rig_from_tag.origin()).v;
  const Vec3 face = camera_from_rig.rotation() * (rig_from_tag.rotation() * Vec3{0, 0, 1});
  if (-face.dot(to_tag.normalized()) < kSteepestCosine) {
    return std::nullopt;
  }
  nav::TagCorners corners;
  const auto in_tag = nav::corners_in_marker(size_m);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const auto pixel = model.project((camera_from_rig * (rig_from_tag * Point<Tag>{in_tag[i]})).v);
    if (!pixel || pixel->x < kMarginPx || pixel->y < kMarginPx ||
        pixel->x > model.width_px() - kMarginPx || pixel->y > model.height_px() - kMarginPx) {
      return std::nullopt;
    }
    corners[i] = *pixel + Vec2{random.normal(0, noise_px), random.normal(0, noise_px)};
  }
  return corners;
}

}  // namespace

nav::PairSightings TagBodyScene::seen(const Transform<Rig, Marker>& rig_from_marker,
                                      Random& random) const {
  const nav::TagGeometry geometry(calibration);
  nav::PairSightings sightings;
  for (std::size_t i = 0; i < tags.size(); ++i) {
    const auto rig_from_tag = rig_from_marker * marker_from_tag[i];
    nav::TagSighting sighting;
    sighting.tag = i;
    sighting.left_px = corners_in(seen_by.left, seen_by.left_from_rig, rig_from_tag, tags[i].size_m,
                                  noise_px, random);
    sighting.right_px = corners_in(seen_by.right, seen_by.right_from_rig, rig_from_tag,
                                   tags[i].size_m, noise_px, random);
    if (sighting.left_px && sighting.right_px) {
      sighting.pose = geometry.pose({*sighting.left_px, *sighting.right_px}, tags[i].size_m);
    }
    if (sighting.left_px || sighting.right_px) {
      sightings.push_back(sighting);
    }
  }
  return sightings;
}

TagBodyScene prism() {
  TagBodyScene scene;
  constexpr double kSide = 1.0471975511965976;  // 60°
  for (int side = 0; side < 3; ++side) {
    scene.tags.push_back({"tag36h11", 3 + side, 0.04});
    const double angle_rad = kSide * (side == 2 ? -1 : side);
    const Mat3 rotation = rotation_from_vector({0, angle_rad, 0}) *
                          rotation_from_vector({0.05 * side, 0, 0.1 * side});
    // Far enough from the axis, which is behind the first face, for white borders to have room.
    const Vec3 axis{0, 0, -0.05};
    const Vec3 out = rotation_from_vector({0, angle_rad, 0}) * Vec3{0, 0, 0.05};
    scene.marker_from_tag.emplace_back(side == 0 ? Mat3::identity() : rotation,
                                       axis + out + Vec3{0, 0.003 * side, 0});
  }
  return scene;
}

std::vector<Transform<Rig, Marker>> turning(int pairs) {
  std::vector<Transform<Rig, Marker>> poses;
  for (int i = 0; i < pairs; ++i) {
    const double t = static_cast<double>(i) / pairs;
    const Mat3 rotation = rotation_from_vector({0.35 * std::sin(23.0 * t), 0, 0}) *
                          rotation_from_vector({0, 0.9 * std::sin(14.0 * t), 0}) *
                          rotation_from_vector({0, 0, 0.5 * std::sin(31.0 * t)});
    const Vec3 offset{0.02 * std::sin(9.0 * t), 0.03 * std::cos(11.0 * t),
                      0.03 * std::sin(17.0 * t)};
    poses.push_back(facing(offset));
    poses.back() = {rotation, poses.back().translation()};
  }
  return poses;
}

}  // namespace orthonav::test
