#include "nav/geometry/rays.h"

#include <cmath>

namespace orthonav::nav {
namespace {

constexpr double kParallelRad = 1e-6;

}  // namespace

std::optional<RayMeeting> closest_point(const Ray& a, const Ray& b) {
  const Vec3 u = a.direction.normalized();
  const Vec3 v = b.direction.normalized();
  const Vec3 across = u.cross(v);
  const double sine_squared = across.squared_norm();
  // Negated, so that NaN is refused too.
  if (!(sine_squared > kParallelRad * kParallelRad)) {
    return std::nullopt;
  }
  const Vec3 between = b.origin_m - a.origin_m;
  const double along_a_m = between.cross(v).dot(across) / sine_squared;
  const double along_b_m = between.cross(u).dot(across) / sine_squared;
  if (!(along_a_m > 0.0) || !(along_b_m > 0.0)) {
    return std::nullopt;
  }
  const Vec3 on_a = a.origin_m + along_a_m * u;
  const Vec3 on_b = b.origin_m + along_b_m * v;
  RayMeeting meeting{0.5 * (on_a + on_b), (on_a - on_b).norm()};
  if (!meeting.point_m.is_finite()) {
    return std::nullopt;
  }
  return meeting;
}

}  // namespace orthonav::nav
