#include "nav/guidance/rod.h"

#include <algorithm>
#include <numeric>

#include "base/angle.h"
#include "base/reason.h"
#include "base/translation.h"
#include "nav/geometry/principal_axes.h"
#include "nav/geometry/spline.h"

namespace orthonav::nav {
namespace {

/// The head of a screw is at least 8 mm wide along the rod. Two heads nearer to each other than
/// this, with touch errors of 1-2 mm each, are one head touched twice.
constexpr double kClosestHeads_m = 0.005;
/// Heads lie 15-60 mm apart; over three levels without screws (37 mm each), as far as this.
constexpr double kFarthestHead_m = 0.15;
/// From T1 to the pelvis a rod is half a metre long; a greater length is a mistake of units.
constexpr double kLongestRod_m = 0.6;
/// Surgeons bend 5.5 mm rods by up to 30-40° at one place, over a pedicle subtraction osteotomy;
/// 60° is the sharpest contour in fatigue tests, in which such rods break early (Tang et al. 2013,
/// Neurosurgery 72:276). Entries of lumbar plans need up to 27°. Points that need more than 60° are
/// not the heads of one rod.
constexpr double kSharpest_rad = 60.0 * kRadiansPerDegree;
constexpr double kBack_rad = 90.0 * kRadiansPerDegree;
constexpr double kSampling_m = 0.001;

/// A length outside its limits.
NearLimit outside(double length_m, double shortest_m, double longest_m) {
  const double limit_m = length_m < shortest_m ? shortest_m : longest_m;
  return {length_m * 1e3, limit_m * 1e3, "%.4g mm;%.4g"};
}

Error apart(std::size_t i, std::size_t j, double gap_m) {
  return refused({translatable("screw heads %zu and %zu are %s apart, limit 5-150 mm"),
                  {i + 1, j + 1, outside(gap_m, kClosestHeads_m, kFarthestHead_m)}});
}

Status check(std::span<const Vec3> heads_m, double diameter_m) {
  if (!(diameter_m >= kThinnestRod_m && diameter_m <= kThickestRod_m)) {
    return refused({translatable("rod diameter is %s, limit 1-15 mm"),
                    {outside(diameter_m, kThinnestRod_m, kThickestRod_m)}});
  }
  if (heads_m.size() < 2) {
    return refused({translatable("rod needs at least 2 screw heads, got %zu"), {heads_m.size()}});
  }
  for (std::size_t i = 0; i < heads_m.size(); ++i) {
    if (!heads_m[i].is_finite()) {
      return refused({translatable("screw head %zu is not finite"), {i + 1}});
    }
  }
  for (std::size_t i = 0; i < heads_m.size(); ++i) {
    for (std::size_t j = i + 1; j < heads_m.size(); ++j) {
      const double gap_m = (heads_m[i] - heads_m[j]).norm();
      if (gap_m < kClosestHeads_m) {
        return apart(i, j, gap_m);
      }
    }
  }
  return {};
}

/// Along the principal axis, beginning at the end where the first of the given heads lies.
std::vector<std::size_t> order_along_rod(std::span<const Vec3> heads_m) {
  const PrincipalAxes pca = principal_axes(heads_m);
  const auto along = [&](std::size_t i) { return pca.axes[0].dot(heads_m[i]); };
  std::vector<std::size_t> order(heads_m.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return along(a) < along(b); });
  const double middle = 0.5 * (along(order.front()) + along(order.back()));
  if (along(0) > middle) {
    std::reverse(order.begin(), order.end());
  }
  return order;
}

double bend_rad(std::span<const Vec3> heads_m, std::size_t i) {
  return angle_between_rad(heads_m[i] - heads_m[i - 1], heads_m[i + 1] - heads_m[i]);
}

/// Checks whether a spinal rod can run along these heads; `order` holds their indices as given.
Status check_run(std::span<const Vec3> heads_m, std::span<const std::size_t> order) {
  for (std::size_t i = 1; i < heads_m.size(); ++i) {
    const double gap_m = (heads_m[i] - heads_m[i - 1]).norm();
    if (gap_m > kFarthestHead_m) {
      return apart(std::min(order[i - 1], order[i]), std::max(order[i - 1], order[i]), gap_m);
    }
  }
  for (std::size_t i = 1; i + 1 < heads_m.size(); ++i) {
    const double angle_rad = bend_rad(heads_m, i);
    if (angle_rad > kSharpest_rad) {
      return refused({angle_rad > kBack_rad
                          ? translatable("rod doubles back by %s° at screw head %zu, limit 60°")
                          : translatable("rod bends by %s° at screw head %zu, limit 60°"),
                      {NearLimit{angle_rad * kDegreesPerRadian, kSharpest_rad * kDegreesPerRadian},
                       order[i] + 1}});
    }
  }
  return {};
}

}  // namespace

Result<RodTemplate> rod_template(std::span<const Vec3> heads_m, double diameter_m) {
  if (const Status s = check(heads_m, diameter_m); !s) {
    return s.error();
  }
  RodTemplate rod;
  rod.diameter_m = diameter_m;
  const std::vector<std::size_t> order = order_along_rod(heads_m);
  for (const std::size_t i : order) {
    rod.heads_m.push_back(heads_m[i]);
  }
  if (const Status s = check_run(rod.heads_m, order); !s) {
    return s.error();
  }
  const auto spline = CatmullRom::through(rod.heads_m);
  if (!spline) {
    return spline.error();
  }
  rod.path_m = spline->sampled(kSampling_m);
  for (std::size_t i = 0; i + 1 < rod.heads_m.size(); ++i) {
    if (i > 0) {
      rod.bends.push_back({rod.length_m, bend_rad(rod.heads_m, i), rod.heads_m[i]});
    }
    rod.length_m += spline->segment_length_m(i);
  }
  if (rod.length_m > kLongestRod_m) {
    return refused({translatable("rod is %s long, limit 600 mm"),
                    {outside(rod.length_m, 0.0, kLongestRod_m)}});
  }
  return rod;
}

}  // namespace orthonav::nav
