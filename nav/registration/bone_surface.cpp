#include "nav/registration/bone_surface.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace orthonav::nav::posterior {

BoneSurface::BoneSurface(const VertebraModel& model, bool mirrored)
    : model_(&model), side_(mirrored ? -1.0 : 1.0) {}

BoneSurface::Place BoneSurface::at(Vec3 query_m, double within_m) const {
  const auto swapped = [&](Vec3 v) { return Vec3{side_ * v.x, v.y, v.z}; };
  query_m = swapped(query_m);
  const auto nearest = model_->surface().nearest(query_m, within_m);
  if (!nearest) {
    return {within_m, {}, swapped(query_m)};
  }
  constexpr double kOnSurface_m = 1e-7;
  constexpr double kClear = 0.5;
  const Vec3 off = query_m - nearest->point_m;
  // Beside an edge the nearest face alone does not tell the side.
  const double along = off.dot(nearest->normal);
  const bool clear = std::abs(along) > kClear * nearest->distance_m;
  const bool inside = clear ? along < 0.0 : model_->surface().contains(query_m);
  const double side = inside ? -1.0 : 1.0;
  const Vec3 out =
      nearest->distance_m > kOnSurface_m ? (side / nearest->distance_m) * off : nearest->normal;
  return {side * nearest->distance_m, swapped(out), swapped(nearest->point_m)};
}

Vec3 BoneSurface::place_near(Vec3 query_m) const {
  const Vec3 found = model_->reachable_grid().nearest({side_ * query_m.x, query_m.y, query_m.z});
  return {side_ * found.x, found.y, found.z};
}

BoneSurface::Place BoneSurface::near(Vec3 query_m, Vec3 hint_m) const {
  constexpr double kRounding = 1.0 + 1e-12;
  return at(query_m, (query_m - hint_m).norm() * kRounding + 1e-12);
}

double BoneSurface::mean_height_around_m(Vec3 place_m, Vec3 out, double aside_m) const {
  constexpr int kDirections = 8;
  if (!(out.squared_norm() > 0.5)) {
    return 0.0;
  }
  const Vec3 any = std::abs(out.x) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 first = out.cross(any).normalized();
  const Vec3 second = out.cross(first);
  double sum_m = 0.0;
  for (int k = 0; k < kDirections; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / kDirections;
    const Vec3 beside_m = place_m + aside_m * (std::cos(angle) * first + std::sin(angle) * second);
    // Both lie on the surface: the nearer one leaves less to be searched.
    const Vec3 other_m = place_near(beside_m);
    const bool nearer = (other_m - beside_m).squared_norm() < aside_m * aside_m;
    sum_m += near(beside_m, nearer ? other_m : place_m).distance_m;
  }
  return sum_m / kDirections;
}

double BoneSurface::curvature_1_m(Vec3 place_m, Vec3 out, double aside_m) const {
  // At this distance along the tangents the bone lies lower by half the curvature times its square.
  return 4.0 * mean_height_around_m(place_m, out, aside_m) / (aside_m * aside_m);
}

}  // namespace orthonav::nav::posterior
