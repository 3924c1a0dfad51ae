#include "hal/sim/cameras/depth_renderer.h"

#include <algorithm>
#include <cmath>

namespace orthonav::sim {
namespace {

/// Finer than the sensor's steps of 1 mm.
constexpr double kSensedCellM = 0.0008;
constexpr float kNearestM = 0.02F;

Material material_of(Ground::Kind kind) {
  switch (kind) {
    case Ground::Kind::kNothing:
      return Material::kNothing;
    case Ground::Kind::kFloor:
      return Material::kFloor;
    case Ground::Kind::kDrape:
      return Material::kDrape;
    case Ground::Kind::kSkin:
      return Material::kSkin;
    case Ground::Kind::kWall:
    case Ground::Kind::kTissue:
      return Material::kTissue;
  }
  return Material::kNothing;
}

Material material_of(const Capsule& capsule) {
  if (capsule.tool < 0) {
    return Material::kGlove;
  }
  constexpr float kShiny = 0.3F;
  return capsule.gloss >= kShiny ? Material::kMetal : Material::kPlastic;
}

std::array<float, 3> as_floats(Vec3 v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

Vec3 as_vector(const DepthCalibration::Ray& ray) { return {ray[0], ray[1], ray[2]}; }

/// How far a point lies outside a tapered rod.
double outside(const Capsule& rod, Vec3 p) {
  const Vec3 axis = rod.b - rod.a;
  const double length2 = axis.squared_norm();
  const double s = length2 > 0.0 ? std::clamp((p - rod.a).dot(axis) / length2, 0.0, 1.0) : 0.0;
  const double radius = rod.radius_a_m + s * (rod.radius_b_m - rod.radius_a_m);
  return (p - (rod.a + s * axis)).norm() - radius;
}

/// Steps along the ray by distances that are certainly free, to within 0.05 mm; 0 if it misses.
float range_to(const Capsule& rod, Vec3 ray) {
  constexpr int kMostSteps = 60;
  constexpr double kReachedM = 5e-5;
  const Vec3 middle = 0.5 * (rod.a + rod.b);
  const double reach = 0.5 * (rod.b - rod.a).norm() + std::max(rod.radius_a_m, rod.radius_b_m);
  double t = std::max(0.0, middle.dot(ray) - reach);
  const double last = middle.dot(ray) + reach;
  for (int i = 0; i < kMostSteps && t <= last; ++i) {
    const double free_m = outside(rod, t * ray);
    if (free_m < kReachedM) {
      return static_cast<float>(t);
    }
    t += free_m;
  }
  return 0.0F;
}

}  // namespace

DepthRenderer::DepthRenderer(const RoomDescription& room, const DepthModel& model)
    : model_(model),
      calibration_(calibration_of(model)),
      ground_(room),
      bones_(room, ground_, kSensedCellM),
      bodies_(room) {}

void DepthRenderer::render(const RoomState& state, std::vector<DepthSight>& sights) {
  sights.assign(calibration_.rays.size(), {});
  // The renderers' frame of a camera is called LeftCamera, whichever camera it is.
  const Transform<LeftCamera, Rig> camera_from_rig(model_.sensor_from_rig.rotation(),
                                                   model_.sensor_from_rig.translation());
  const auto camera_from_room = camera_from_rig * state.room_from_rig.inverse();
  const auto camera_from_spine = camera_from_room * state.room_from_spine;
  see_ground(camera_from_spine, sights);
  see_bones(camera_from_spine, sights);
  bodies_.gather(state, camera_from_room, solids_, 0.0);
  for (const Plate& plate : solids_.plates) {
    see(plate, sights);
  }
  for (const Capsule& capsule : solids_.capsules) {
    see(capsule, sights);
  }
}

void DepthRenderer::see_ground(const Transform<LeftCamera, Spine>& camera_from_spine,
                               std::vector<DepthSight>& sights) const {
  const auto spine_from_camera = camera_from_spine.inverse();
  const auto eye = as_floats(spine_from_camera.translation());
  const Mat3& rotation = spine_from_camera.rotation();
  for (std::size_t i = 0; i < sights.size(); ++i) {
    const auto& ray = calibration_.rays[i];
    if (ray[2] == 0.0F) {
      continue;
    }
    const Ground::Hit hit = ground_.hit(eye, as_floats(rotation * as_vector(ray)));
    const Material material = material_of(hit.kind);
    if (material != Material::kNothing && hit.distance > kNearestM) {
      sights[i] = {hit.distance, material};
    }
  }
}

void DepthRenderer::see_bones(const Transform<LeftCamera, Spine>& camera_from_spine,
                              std::vector<DepthSight>& sights) {
  bone_image_.reset(calibration_.width_px, calibration_.height_px);
  bone_image_.draw(bones_, ground_, camera_from_spine, DepthLens{model_.lens}, 1.0);
  const auto width = static_cast<std::size_t>(calibration_.width_px);
  const auto low = static_cast<std::size_t>(bone_image_.low_row()) * width;
  const auto high = static_cast<std::size_t>(std::max(bone_image_.high_row(), 0)) * width;
  for (std::size_t i = low; i < high; ++i) {
    const float nearness = bone_image_.nearness()[i];
    const float along = calibration_.rays[i][2];
    if (nearness > 0.0F && along > 0.0F) {
      sights[i] = {1.0F / (nearness * along), Material::kBone};
    }
  }
}

DepthRenderer::Window DepthRenderer::window_around(Vec3 centre, double radius_m) const {
  // A sphere's image is at most this factor larger off the axis than on it.
  constexpr double kWider = 2.0;
  const int width = calibration_.width_px;
  const int height = calibration_.height_px;
  if (centre.z <= radius_m) {
    return {0, width, 0, height};
  }
  const Vec2 at = DepthLens{model_.lens}.rough_pixel(centre);
  const double nearest = centre.z - radius_m;
  const double around =
      2.0 + kWider * model_.lens.fx_px * radius_m / nearest * centre.norm() / centre.z;
  const auto from = [&](double v, int most) {
    return static_cast<int>(std::clamp(std::floor(v - around), 0.0, double(most)));
  };
  const auto to = [&](double v, int most) {
    return static_cast<int>(std::clamp(std::ceil(v + around), 0.0, double(most)));
  };
  return {from(at.x, width), to(at.x, width), from(at.y, height), to(at.y, height)};
}

/// `range_along` returns the range at which a ray meets the body, 0 if it does not.
template <class RangeAlong>
void DepthRenderer::see_in(const Window& window, Material material, const RangeAlong& range_along,
                           std::vector<DepthSight>& sights) const {
  for (int y = window.y0; y < window.y1; ++y) {
    for (int x = window.x0; x < window.x1; ++x) {
      const auto i = static_cast<std::size_t>(y) * static_cast<std::size_t>(calibration_.width_px) +
                     static_cast<std::size_t>(x);
      const auto& ray = calibration_.rays[i];
      if (ray[2] == 0.0F) {
        continue;
      }
      const float range_m = range_along(as_vector(ray));
      const float before_m = sights[i].range_m;
      if (range_m > kNearestM && (before_m == 0.0F || range_m < before_m)) {
        sights[i] = {range_m, material};
      }
    }
  }
}

void DepthRenderer::see(const Plate& plate, std::vector<DepthSight>& sights) const {
  const auto marker_from_camera = plate.camera_from_marker.inverse();
  const Vec3 eye = marker_from_camera.translation();
  const Mat3& rotation = marker_from_camera.rotation();
  const double half_m = plate.half_m;
  const auto range_along = [&](Vec3 ray) {
    const Vec3 along = rotation * ray;
    const double t = -eye.z / along.z;
    const Vec3 at = eye + t * along;
    const bool hit = t > 0.0 && std::abs(at.x) <= half_m && std::abs(at.y) <= half_m;
    return hit ? static_cast<float>(t) : 0.0F;
  };
  see_in(window_around(plate.camera_from_marker.translation(), std::sqrt(2.0) * half_m),
         Material::kPaper, range_along, sights);
}

void DepthRenderer::see(const Capsule& capsule, std::vector<DepthSight>& sights) const {
  const double radius_m =
      0.5 * (capsule.b - capsule.a).norm() + std::max(capsule.radius_a_m, capsule.radius_b_m);
  const auto range_along = [&](Vec3 ray) { return range_to(capsule, ray); };
  see_in(window_around(0.5 * (capsule.a + capsule.b), radius_m), material_of(capsule), range_along,
         sights);
}

}  // namespace orthonav::sim
