#include "nav/guidance/rod.h"

#include <algorithm>
#include <cstdio>
#include <string>

#include "nav/geometry/spline.h"
#include "nav/registration/principal_axes.h"

namespace orthonav::nav {
namespace {

constexpr double kClosest_m = 0.001;
/// From T1 to the pelvis a rod is half a metre long; more is a slip of the unit.
constexpr double kFarthest_m = 0.6;
constexpr double kSampling_m = 0.001;

std::string millimetres(double m) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g mm", m * 1e3);
  return text;
}

Status check(std::span<const Vec3> heads_m, double diameter_m) {
  if (!(diameter_m >= kThinnestRod_m && diameter_m <= kThickestRod_m)) {
    return Error{"rod diameter is " + millimetres(diameter_m) + ", limit 1-15 mm"};
  }
  if (heads_m.size() < 2) {
    return Error{"rod needs at least 2 screw heads, got " + std::to_string(heads_m.size())};
  }
  for (std::size_t i = 0; i < heads_m.size(); ++i) {
    if (!heads_m[i].is_finite()) {
      return Error{"screw head " + std::to_string(i + 1) + " is not finite"};
    }
  }
  for (std::size_t i = 0; i < heads_m.size(); ++i) {
    for (std::size_t j = i + 1; j < heads_m.size(); ++j) {
      const double gap_m = (heads_m[i] - heads_m[j]).norm();
      if (gap_m >= kClosest_m && gap_m <= kFarthest_m) {
        continue;
      }
      return Error{"screw heads " + std::to_string(i + 1) + " and " + std::to_string(j + 1) +
                   " are " + millimetres(gap_m) + " apart, limit 1-600 mm"};
    }
  }
  return {};
}

/// Along the principal axis, beginning at the end where the first of the given heads lies.
std::vector<Vec3> in_order(std::span<const Vec3> heads_m) {
  const PrincipalAxes pca = principal_axes(heads_m);
  const auto along = [&](Vec3 p) { return pca.axes[0].dot(p); };
  std::vector<Vec3> sorted(heads_m.begin(), heads_m.end());
  std::stable_sort(sorted.begin(), sorted.end(),
                   [&](Vec3 a, Vec3 b) { return along(a) < along(b); });
  const double middle = 0.5 * (along(sorted.front()) + along(sorted.back()));
  if (along(heads_m.front()) > middle) {
    std::reverse(sorted.begin(), sorted.end());
  }
  return sorted;
}

}  // namespace

Result<RodTemplate> rod_template(std::span<const Vec3> heads_m, double diameter_m) {
  if (const Status s = check(heads_m, diameter_m); !s) {
    return s.error();
  }
  RodTemplate rod;
  rod.diameter_m = diameter_m;
  rod.heads_m = in_order(heads_m);
  const auto spline = CatmullRom::through(rod.heads_m);
  if (!spline) {
    return spline.error();
  }
  rod.path_m = spline->sampled(kSampling_m);
  for (std::size_t i = 0; i + 1 < rod.heads_m.size(); ++i) {
    if (i > 0) {
      rod.bends.push_back({rod.length_m,
                           angle_between_rad(rod.heads_m[i] - rod.heads_m[i - 1],
                                             rod.heads_m[i + 1] - rod.heads_m[i]),
                           rod.heads_m[i]});
    }
    rod.length_m += spline->segment_length_m(i);
  }
  return rod;
}

}  // namespace orthonav::nav
