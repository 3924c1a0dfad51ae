#include "nav/registration/bone_surface.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace orthonav::nav::posterior {

BoneSurface::BoneSurface(const VertebraModel& model, bool mirrored)
    : model_(&model), side_(mirrored ? -1.0 : 1.0) {}

std::optional<BoneSurface::Place> BoneSurface::within(Vec3 query_m, double within_m) const {
  const auto swapped = [&](Vec3 v) { return Vec3{side_ * v.x, v.y, v.z}; };
  query_m = swapped(query_m);
  const auto nearest = model_->surface().nearest(query_m, within_m);
  if (!nearest) {
    return std::nullopt;
  }
  constexpr double kOnSurface_m = 1e-7;
  const double side = model_->surface().contains(query_m, *nearest) ? -1.0 : 1.0;
  const Vec3 out = nearest->distance_m > kOnSurface_m
                       ? (side / nearest->distance_m) * (query_m - nearest->point_m)
                       : nearest->normal;
  return Place{side * nearest->distance_m, swapped(out), swapped(nearest->point_m)};
}

BoneSurface::Place BoneSurface::at(Vec3 query_m) const {
  // The field tells the distance to a part of the surface, nearly always to within this; the whole
  // surface is no farther.
  constexpr double kField_m = 0.001;
  DistanceField::Value value;
  if (model_->search_field().field().at({side_ * query_m.x, query_m.y, query_m.z}, value)) {
    if (const auto found = within(query_m, std::abs(value.distance_m) + kField_m)) {
      return *found;
    }
  }
  constexpr double kAnywhere_m = 1e9;
  return within(query_m, kAnywhere_m).value_or(Place{kAnywhere_m, {}, query_m});
}

BoneSurface::Place BoneSurface::near(Vec3 query_m, Vec3 hint_m) const {
  constexpr double kRounding = 1.0 + 1e-12;
  const auto found = within(query_m, (query_m - hint_m).norm() * kRounding + 1e-12);
  return found ? *found : at(query_m);
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
    sum_m += at(beside_m).distance_m;
  }
  return sum_m / kDirections;
}

double BoneSurface::curvature_1_m(Vec3 place_m, Vec3 out, double aside_m) const {
  // At this distance along the tangents the bone lies lower by half the curvature times its square.
  return 4.0 * mean_height_around_m(place_m, out, aside_m) / (aside_m * aside_m);
}

}  // namespace orthonav::nav::posterior
