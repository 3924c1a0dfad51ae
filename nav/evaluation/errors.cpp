#include "nav/evaluation/errors.h"

#include <algorithm>
#include <cmath>

namespace orthonav::nav {

ScrewError screw_error(const ScrewPlan& plan, const Axis<Vertebra>& executed,
                       const SurfaceIndex& model) {
  ScrewError error;
  error.angle_rad = angle_between_rad(plan.target - plan.entry, executed.direction);
  const auto nearest = model.nearest(executed.point.v);
  const double length = executed.direction.norm();
  if (!nearest || !(length > 0.0)) {
    return error;
  }
  // A vertebra's diagonal is below 0.44 m, so a point this far back along the axis is outside it.
  constexpr double kDiagonal_m = 0.44;
  const Vec3 outside_m =
      executed.point.v - (nearest->distance_m + kDiagonal_m) / length * executed.direction;
  if (const auto hit = model.first_hit(outside_m, executed.direction)) {
    error.entry_m = (hit->point_m - plan.entry.v).norm();
  }
  return error;
}

Summary summarize(std::span<const double> values) {
  Summary s;
  s.count = values.size();
  if (values.empty()) {
    return s;
  }
  const auto n = static_cast<double>(values.size());
  for (const double v : values) {
    s.mean += v / n;
  }
  double squares = 0.0;
  for (const double v : values) {
    squares += (v - s.mean) * (v - s.mean);
  }
  s.sd = values.size() > 1 ? std::sqrt(squares / (n - 1.0)) : 0.0;
  const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
  s.min = *least;
  s.max = *greatest;
  return s;
}

}  // namespace orthonav::nav
