#include "nav/calibration/epipolar.h"

#include <cmath>

namespace orthonav::nav {

std::optional<double> across_epipolar_px(const CameraModel& left, const CameraModel& right,
                                         const Transform<RightCamera, LeftCamera>& right_from_left,
                                         Vec2 left_px, Vec2 right_px) {
  const auto from_left = left.unproject(left_px);
  const auto from_right = right.unproject(right_px);
  const auto jacobian = right.jacobian_px(right_px);
  if (!from_left || !from_right || !jacobian) {
    return std::nullopt;
  }
  const Vec3 ray = right_from_left.rotation() * Vec3{from_left->x, from_left->y, 1.0};
  // The plane of both rays cuts the right camera's unit plane in line.x x + line.y y + line.z = 0.
  const Vec3 line = right_from_left.translation().cross(ray);
  const double off = line.dot({from_right->x, from_right->y, 1.0});
  // The gradient with respect to the pixel is that on the unit plane times the inverse Jacobian.
  const auto& [a, b, c, d] = *jacobian;
  const double det = a * d - b * c;
  const Vec2 gradient{(line.x * d - line.y * c) / det, (line.y * a - line.x * b) / det};
  const double steepness = gradient.norm();
  if (!(steepness > 0.0) || !std::isfinite(steepness)) {
    return std::nullopt;
  }
  return off / steepness;
}

}  // namespace orthonav::nav
