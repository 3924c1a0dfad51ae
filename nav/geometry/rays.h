#pragma once

#include <optional>

#include "base/vec.h"

namespace orthonav::nav {

/// From `origin_m` along `direction`, which may have any length but zero.
struct Ray {
  Vec3 origin_m;
  Vec3 direction;
};

/// Where two rays come closest.
struct RayMeeting {
  Vec3 point_m;        ///< the middle of the shortest segment between them
  double gap_m = 0.0;  ///< its length
};

/// The point closest to both rays (mid-point method: Hartley & Sturm 1997, "Triangulation").
/// Empty if they are parallel within 1e-6 rad, if the meeting lies behind either origin, or if a
/// number is not finite.
[[nodiscard]] std::optional<RayMeeting> closest_point(const Ray& a, const Ray& b);

}  // namespace orthonav::nav
