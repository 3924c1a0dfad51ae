#include "nav/geometry/surface_depth.h"

#include <algorithm>
#include <cmath>

namespace orthonav::nav {
namespace {

/// Cosine between the nearest face's normal and the direction from the face to the place. It is 1
/// above the interior of a face. Above an edge, the face that happens to be chosen gives the wrong
/// side only if two faces meet at less than acos(0.95) = 18°, as on the edge of a blade.
constexpr double kBeyondDoubt = 0.95;
/// Allowance for rounding of a distance and its square: a point as near as the last one must still
/// be found.
constexpr double kRounding = 1e-12;
constexpr double kRounding_m = 1e-15;
constexpr double kOnFace_m = 1e-9;

bool lies_inside(const SurfaceIndex& closed, Vec3 place_m, const SurfacePoint& nearest) {
  const double above_m = (place_m - nearest.point_m).dot(nearest.normal);
  if (std::abs(above_m) >= kBeyondDoubt * nearest.distance_m) {
    return above_m <= 0.0;
  }
  return closed.contains(place_m);
}

}  // namespace

std::optional<SurfaceDepth> DepthProbe::at(Vec3 place_m, double within_m) {
  if (last_m_) {
    within_m = std::min(within_m, (*last_m_ - place_m).norm() * (1.0 + kRounding) + kRounding_m);
  }
  const auto nearest = closed_.nearest(place_m, within_m);
  if (!nearest) {
    return std::nullopt;
  }
  last_m_ = nearest->point_m;
  const double side = lies_inside(closed_, place_m, *nearest) ? 1.0 : -1.0;
  // Practically on the surface the difference is only rounding, so the face gives the direction
  // inward.
  const Vec3 deeper = nearest->distance_m > kOnFace_m
                          ? (side / nearest->distance_m) * (place_m - nearest->point_m)
                          : -nearest->normal;
  return SurfaceDepth{side * nearest->distance_m, deeper};
}

}  // namespace orthonav::nav
