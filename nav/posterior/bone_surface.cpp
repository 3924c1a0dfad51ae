#include "nav/posterior/bone_surface.h"

#include <algorithm>
#include <cmath>

namespace orthonav::nav::posterior {

BoneSurface::BoneSurface(const VertebraModel& model) : model_(&model) {}

BoneSurface::Place BoneSurface::at(Vec3 query_m, double within_m) const {
  const auto nearest = model_->surface().nearest(query_m, within_m);
  if (!nearest) {
    return {within_m, {}, query_m};
  }
  constexpr double kOnSurface_m = 1e-7;
  constexpr double kClear = 0.5;
  const Vec3 off = query_m - nearest->point_m;
  // Beside an edge the nearest face alone does not tell the side.
  const double along = off.dot(nearest->normal);
  const bool clear = std::abs(along) > kClear * nearest->distance_m;
  const bool inside = clear ? along < 0.0 : model_->surface().contains(query_m);
  const double side = inside ? -1.0 : 1.0;
  return {side * nearest->distance_m,
          nearest->distance_m > kOnSurface_m ? (side / nearest->distance_m) * off : nearest->normal,
          nearest->point_m};
}

BoneSurface::Place BoneSurface::near(Vec3 query_m, Vec3 hint_m) const {
  constexpr double kRounding = 1.0 + 1e-12;
  return at(query_m, (query_m - hint_m).norm() * kRounding + 1e-12);
}

}  // namespace orthonav::nav::posterior
