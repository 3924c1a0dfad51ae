#include "hal/sim/cameras/tag_occlusion.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace orthonav::sim {
namespace {

/// What is nearer to the tag than this part of the way touches it rather than hides it.
constexpr double kBeforeIt = 0.98;
constexpr std::array<Vec2, 8> kBorder = {
    {{-1, -1}, {0, -1}, {1, -1}, {1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}}};

/// Whether a straight way from the camera to `end` comes within `margin_m` of the body (Ericson
/// 2005, 5.1.9).
bool passes(const Capsule& body, Vec3 end, double margin_m) {
  const Vec3 axis = body.b - body.a;
  const double ee = end.dot(end);
  const double aa = std::max(axis.dot(axis), 1e-12);
  const double ea = end.dot(axis);
  const double from_e = -end.dot(body.a);
  const double from_a = -axis.dot(body.a);
  const double det = ee * aa - ea * ea;
  double way = det > 1e-12 ? std::clamp((ea * from_a - from_e * aa) / det, 0.0, 1.0) : 0.0;
  const double along = std::clamp((ea * way + from_a) / aa, 0.0, 1.0);
  way = std::clamp((ea * along - from_e) / ee, 0.0, 1.0);
  const double radius = body.radius_a_m + along * (body.radius_b_m - body.radius_a_m);
  return (way * end - (body.a + along * axis)).norm() < radius + margin_m;
}

bool passes(const Transform<Marker, LeftCamera>& marker_from_camera, double half_m, Vec3 end) {
  const Vec3 from = marker_from_camera.translation();
  const Vec3 to = (marker_from_camera * Point<LeftCamera>{end}).v;
  if ((from.z > 0.0) == (to.z > 0.0)) {
    return false;
  }
  const Vec3 at = from + from.z / (from.z - to.z) * (to - from);
  return std::abs(at.x) < half_m && std::abs(at.y) < half_m;
}

}  // namespace

void TagOcclusion::look(const RoomState& now, const Transform<LeftCamera, Room>& camera_from_room) {
  bodies_.gather(now, camera_from_room, solids_, 0.0);
}

bool TagOcclusion::hides(std::size_t tool) const {
  const int number = static_cast<int>(tool);
  const auto own = std::find_if(solids_.plates.begin(), solids_.plates.end(),
                                [&](const Plate& plate) { return plate.tool == number; });
  if (own == solids_.plates.end()) {
    return false;
  }
  const double half_m = 0.5 * own->size_m;
  std::array<Vec3, kBorder.size()> border;
  for (std::size_t i = 0; i < border.size(); ++i) {
    const Vec2 at = half_m * kBorder[i];
    border[i] = kBeforeIt * (own->camera_from_marker * Point<Marker>{{at.x, at.y, 0.0}}).v;
  }
  const auto hidden_by = [&](const auto& is_between) {
    return std::any_of(border.begin(), border.end(), is_between);
  };
  for (const Plate& plate : solids_.plates) {
    const auto marker_from_camera = plate.camera_from_marker.inverse();
    if (plate.tool != number &&
        hidden_by([&](Vec3 at) { return passes(marker_from_camera, plate.half_m, at); })) {
      return true;
    }
  }
  const Vec3 centre = kBeforeIt * own->camera_from_marker.translation();
  const double reach_m = std::sqrt(2.0) * half_m;
  return std::any_of(solids_.capsules.begin(), solids_.capsules.end(), [&](const Capsule& body) {
    return body.tool != number && passes(body, centre, reach_m) &&
           hidden_by([&](Vec3 at) { return passes(body, at, 0.0); });
  });
}

}  // namespace orthonav::sim
