#include "nav/guidance/rod_stroke.h"

#include <algorithm>
#include <vector>

#include "base/length_text.h"
#include "base/printed.h"
#include "base/translation.h"
#include "nav/geometry/absolute_orientation.h"
#include "nav/geometry/principal_axes.h"
#include "nav/guidance/rod_stroke_fit.h"

namespace orthonav::nav {
namespace {

Status check_stroke(std::span<const Vec3> stroked_m, const RodStrokeRules& rules) {
  if (stroked_m.size() < rules.fewest_points) {
    return Error{printed(translatable("stroke of the rod has %zu points, limit %zu"),
                         stroked_m.size(), rules.fewest_points)};
  }
  for (std::size_t i = 0; i < stroked_m.size(); ++i) {
    if (!stroked_m[i].is_finite()) {
      return Error{printed("point %zu of the stroke is not finite", i + 1)};
    }
  }
  return {};
}

/// Positions along the main direction, scaled to [0, 1], increasing in the given order.
std::vector<double> parts_along(std::span<const Vec3> points_m) {
  const PrincipalAxes axes = principal_axes(points_m);
  std::vector<double> along;
  for (const Vec3& point_m : points_m) {
    along.push_back(axes.axes[0].dot(point_m));
  }
  // The mean product with the index: the direction in which the stroke ran.
  const double middle = 0.5 * static_cast<double>(along.size() - 1);
  double trend = 0.0;
  for (std::size_t i = 0; i < along.size(); ++i) {
    trend += (static_cast<double>(i) - middle) * along[i];
  }
  const auto [least, most] = std::minmax_element(along.begin(), along.end());
  const double low = *least;
  const double span = std::max(*most - low, 1e-9);
  for (double& a : along) {
    a = trend < 0.0 ? 1.0 - (a - low) / span : (a - low) / span;
  }
  return along;
}

/// For every point, the place on the axis at the same fraction of the rod's length.
std::vector<Vec3> partners_on(const std::vector<Vec3>& chain_m, std::span<const Vec3> points_m) {
  const std::vector<double> model = parts_along(chain_m);
  std::vector<Vec3> partners;
  for (const double part : parts_along(points_m)) {
    std::size_t i = 1;
    while (i + 1 < model.size() && model[i] < part) {
      ++i;
    }
    const double span = model[i] - model[i - 1];
    const double between = span > 0.0 ? std::clamp((part - model[i - 1]) / span, 0.0, 1.0) : 0.0;
    partners.push_back(chain_m[i - 1] + between * (chain_m[i] - chain_m[i - 1]));
  }
  return partners;
}

Status check_reach(const std::vector<StrokeFoot>& feet, const RodArc& bend, std::size_t number,
                   const RodStrokeRules& rules) {
  const auto [first, last] = std::minmax_element(
      feet.begin(), feet.end(),
      [](const StrokeFoot& a, const StrokeFoot& b) { return a.along_m < b.along_m; });
  const double beyond_m = 0.5 * bend.width_m + rules.beyond_bend_m;
  if (first->along_m > bend.centre_m - beyond_m || last->along_m < bend.centre_m + beyond_m) {
    return Error{printed(
        translatable("stroke runs from %.0f to %.0f mm of the rod, must pass bend %zu at %.0f mm "
                     "by %.0f mm"),
        first->along_m * 1e3, last->along_m * 1e3, number, bend.centre_m * 1e3, beyond_m * 1e3)};
  }
  return {};
}

Status check_rms(double rms_m, double limit_m) {
  if (rms_m > limit_m) {
    return Error{printed(translatable("stroke lies %s off the rod (rms), limit %.1f mm"),
                         in_mm_outside(rms_m, 0.0, limit_m).c_str(), limit_m * 1e3)};
  }
  return {};
}

struct StrokeEnds {
  Vec3 first_m;  ///< on the points' main direction
  Vec3 last_m;
  Vec3 across;  ///< a unit vector perpendicular to it

  [[nodiscard]] double length_m() const { return (last_m - first_m).norm(); }
};

StrokeEnds stroke_ends(std::span<const Vec3> stroked_m) {
  const PrincipalAxes axes = principal_axes(stroked_m);
  const std::vector<double> parts = parts_along(stroked_m);
  const auto on_axis = [&](auto at) {
    const Vec3 point_m = stroked_m[static_cast<std::size_t>(at - parts.begin())];
    return axes.centre_m + (point_m - axes.centre_m).dot(axes.axes[0]) * axes.axes[0];
  };
  const auto [least, most] = std::minmax_element(parts.begin(), parts.end());
  return {on_axis(least), on_axis(most), axes.axes[1]};
}

/// Where a stroke of a part lies along a rod is not known. Lengths are those of the straight line
/// from end to end.
Status check_whole(const StrokeEnds& ends, double rod_m, const RodStrokeRules& rules) {
  if (!(ends.length_m() >= rod_m - rules.short_of_end_m)) {
    return Error{printed(translatable("stroke is %.0f mm long, the rod %.0f mm: stroke it from end "
                                      "to end"),
                         ends.length_m() * 1e3, rod_m * 1e3)};
  }
  return {};
}

/// A straight rod whose middle is that of the stroke.
RodStrokeTask straight_task(const StrokeEnds& ends, double length_m, double radius_m,
                            std::span<const Vec3> stroked_m) {
  const Vec3 along = (ends.last_m - ends.first_m).normalized();
  const Vec3 first_m = 0.5 * (ends.first_m + ends.last_m) - 0.5 * length_m * along;
  return {{},
          length_m,
          radius_m,
          stroked_m,
          Mat3::from_columns(ends.across, along.cross(ends.across), along),
          first_m};
}

}  // namespace

Result<MeasuredBend> measured_bend(std::span<const RodArc> arcs, double length_m, double diameter_m,
                                   std::span<const Vec3> stroked_m, const RodStrokeRules& rules) {
  if (arcs.empty()) {
    return Error{"stroke of a rod without a bend: there is nothing to measure"};
  }
  if (const Status s = check_stroke(stroked_m, rules); !s) {
    return s.error();
  }
  const std::vector<Vec3> chain_m = rod_axis(arcs, length_m);
  if (const Status s = check_whole(stroke_ends(stroked_m), stroke_ends(chain_m).length_m(), rules);
      !s) {
    return s.error();
  }
  const auto laid = absolute_orientation(partners_on(chain_m, stroked_m), stroked_m);
  if (!laid) {
    return Error{"stroke of the rod: " + laid.error().message, laid.error().code};
  }
  const auto fit = fit_rod_stroke(
      {arcs, length_m, 0.5 * diameter_m, stroked_m, laid->rotation, laid->translation_m}, rules);
  if (!fit) {
    return fit.error();
  }
  if (const Status s = check_rms(fit->rod.rms_m, rules.most_rms_m); !s) {
    return s.error();
  }
  if (const Status s = check_reach(fit->feet, fit->rod.arc, arcs.size(), rules); !s) {
    return s.error();
  }
  return fit->rod;
}

Result<LaidRod> laid_rod(double length_m, double diameter_m, std::span<const Vec3> stroked_m,
                         const RodStrokeRules& rules) {
  if (const Status s = check_stroke(stroked_m, rules); !s) {
    return s.error();
  }
  const StrokeEnds ends = stroke_ends(stroked_m);
  if (const Status s = check_whole(ends, length_m, rules); !s) {
    return s.error();
  }
  const double whole_m = std::max(length_m, ends.length_m());
  const auto fit = fit_rod_stroke(straight_task(ends, whole_m, 0.5 * diameter_m, stroked_m), rules);
  if (!fit) {
    return fit.error();
  }
  if (const Status s = check_rms(fit->rod.rms_m, rules.most_rms_straight_m); !s) {
    return s.error();
  }
  return LaidRod{fit->rod.points_from_rod, fit->rod.rod_in_points_m, whole_m, fit->rod.rms_m,
                 fit->rod.one_sided};
}

}  // namespace orthonav::nav
