#include <algorithm>
#include <vector>

#include "base/reason.h"
#include "base/translation.h"
#include "nav/geometry/principal_axes.h"
#include "nav/registration/registration.h"

namespace orthonav::nav {
namespace {

/// Strokes narrower than this (standard deviation) along their second axis are a line.
constexpr double kNarrowest_m = 0.001;
/// Points of one vertebra, and of any other bone, are not farther than this (standard deviation)
/// from their centre.
constexpr double kWidest_m = 0.1;
constexpr double kWidestOfAnyBone_m = 0.3;

}  // namespace

Status validate_points(std::span<const Point<World>> points, std::size_t min_points, Bone bone) {
  const std::size_t fewest = std::max<std::size_t>(min_points, 3);
  if (points.size() < fewest) {
    return refused(
        {translatable("registration has %zu points, needs at least %zu"), {points.size(), fewest}});
  }
  std::vector<Vec3> numbers(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].v.is_finite()) {
      return refused({translatable("registration point %zu is not finite"), {i + 1}});
    }
    numbers[i] = points[i].v;
  }
  const PrincipalAxes axes = principal_axes(numbers);
  const double widest_m = bone == Bone::kVertebra ? kWidest_m : kWidestOfAnyBone_m;
  if (!(axes.deviation_m[0] <= widest_m)) {
    return refused(
        {translatable("registration points spread %.4g mm (standard deviation), limit %.0f mm: "
                      "not one bone, or not in the unit given"),
         {axes.deviation_m[0] * 1e3, widest_m * 1e3},
         true});
  }
  if (!(axes.deviation_m[1] >= kNarrowest_m)) {
    return refused(
        {translatable("registration points lie on a line or in one place (%.3g mm wide, at "
                      "least %.0f mm)"),
         {axes.deviation_m[1] * 1e3, kNarrowest_m * 1e3},
         true});
  }
  return {};
}

Status check_point_sds(std::span<const double> sd_m, std::size_t points) {
  if (sd_m.empty()) {
    return {};
  }
  if (sd_m.size() != points) {
    return refused({translatable("registration: %zu standard deviations of %zu points"),
                    {sd_m.size(), points}});
  }
  const auto bad =
      std::find_if(sd_m.begin(), sd_m.end(), [](double sd) { return !(sd >= 0.0 && sd < 1.0); });
  if (bad == sd_m.end()) {
    return {};
  }
  return refused({translatable("registration: standard deviation of point %zu is %f m, must "
                               "be between 0 and 1 m"),
                  {static_cast<std::size_t>(bad - sd_m.begin()) + 1, *bad}});
}

}  // namespace orthonav::nav
