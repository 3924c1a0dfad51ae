#include "nav/guidance/rod_bends.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

#include "base/angle.h"
#include "base/length_text.h"
#include "base/printed.h"
#include "nav/guidance/rod_shape.h"

namespace orthonav::nav {
namespace {

/// The fit's margin from a tulip's edge, on both sides of a bend.
constexpr double kFittingMargin_m = 0.0002;
/// Number of the gentlest bends that may be left out on trial; the others are needed anyway.
constexpr std::size_t kLeftOutTries = 4;

double least_gap_m(const RodBending& bending) {
  return bending.bender.width_m + bending.tulip_m + kFittingMargin_m;
}

/// The gaps long enough for a bend between their tulips.
std::vector<std::size_t> gaps_for_bends(std::span<const Vec3> seats_m, const RodBending& bending) {
  std::vector<std::size_t> gaps;
  for (std::size_t i = 0; i + 1 < seats_m.size(); ++i) {
    if ((seats_m[i + 1] - seats_m[i]).norm() >= least_gap_m(bending)) {
      gaps.push_back(i);
    }
  }
  return gaps;
}

RodFitTask fit_task(std::span<const Vec3> seats_m, std::vector<std::size_t> gaps,
                    const RodBending& bending, double most_angle_rad) {
  return {.seats_m = seats_m,
          .gaps = std::move(gaps),
          .width_m = bending.bender.width_m,
          .tulip_m = bending.tulip_m,
          .overhang_m = bending.overhang_m,
          .most_angle_rad = most_angle_rad};
}

bool serves(const RodFit& fit, double tolerance_m, double most_angle_rad) {
  return fit.clear && fit.worst_off_m <= tolerance_m && fit.sharpest_rad <= most_angle_rad;
}

struct PlannedRod {
  std::vector<std::size_t> gaps;
  RodFit fit;
};

/// The same rod with one bend fewer, if one can be spared: of those tried, the one that is bent
/// least.
std::optional<PlannedRod> with_a_bend_less(std::span<const Vec3> seats_m, const PlannedRod& rod,
                                           const RodBending& bending, double most_angle_rad) {
  std::vector<std::size_t> order(rod.gaps.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return rod.fit.arcs[a].angle_rad < rod.fit.arcs[b].angle_rad;
  });
  order.resize(std::min(order.size(), kLeftOutTries));
  std::optional<PlannedRod> best;
  for (const std::size_t left_out : order) {
    std::vector<std::size_t> gaps = rod.gaps;
    gaps.erase(gaps.begin() + static_cast<std::ptrdiff_t>(left_out));
    auto fit = fit_rod_bends(fit_task(seats_m, gaps, bending, most_angle_rad));
    if (fit && serves(*fit, bending.tolerance_m, most_angle_rad) &&
        (!best || fit->sum_of_squares < best->fit.sum_of_squares)) {
      best = PlannedRod{std::move(gaps), *std::move(fit)};
    }
  }
  return best;
}

/// Why not even a bend in every gap is enough.
Error out_of_reach(const PlannedRod& rod, std::span<const Vec3> seats_m, const RodBending& bending,
                   const RodSpringBack& spring_back) {
  for (std::size_t k = 0; k < rod.fit.arcs.size(); ++k) {
    const auto set_rad = spring_back.set_rad(rod.fit.arcs[k].angle_rad);
    if (!set_rad && rod.fit.worst_off_m <= bending.tolerance_m) {
      return Error{printed("bend between seats %zu and %zu: %s", rod.gaps[k] + 1, rod.gaps[k] + 2,
                           set_rad.error().message.c_str())};
    }
  }
  const auto worst =
      std::max_element(rod.fit.seats.begin(), rod.fit.seats.end(),
                       [](const SeatOnRod& a, const SeatOnRod& b) { return a.off_m < b.off_m; });
  std::string text = printed("seat %zu is %s off the rod that this bender makes, limit %.2f mm",
                             worst - rod.fit.seats.begin() + 1,
                             in_mm_outside(worst->off_m, 0.0, bending.tolerance_m, 2).c_str(),
                             bending.tolerance_m * 1e3);
  for (std::size_t i = 0; i + 1 < seats_m.size(); ++i) {
    const double gap_m = (seats_m[i + 1] - seats_m[i]).norm();
    if (gap_m < least_gap_m(bending)) {
      append_printed(text, "; no bend fits between seats %zu and %zu: %s apart, at least %.1f mm",
                     i + 1, i + 2, in_mm_outside(gap_m, least_gap_m(bending), 1.0).c_str(),
                     least_gap_m(bending) * 1e3);
      break;
    }
  }
  return Error{text};
}

/// How far the bends of a rod reach into its tulips, at most.
double reach_into_tulips_m(const PlannedRod& rod, const RodBending& bending) {
  double reach_m = 0.0;
  for (std::size_t k = 0; k < rod.gaps.size(); ++k) {
    const RodArc& arc = rod.fit.arcs[k];
    const double half_m = 0.5 * (arc.width_m + bending.tulip_m);
    reach_m = std::max({reach_m, half_m - (arc.centre_m - rod.fit.seats[rod.gaps[k]].at_m),
                        half_m - (rod.fit.seats[rod.gaps[k] + 1].at_m - arc.centre_m)});
  }
  return reach_m;
}

Result<RodInstructions> told(PlannedRod rod, std::span<const Vec3> seats_m, double reach_m,
                             const RodSpringBack& spring_back) {
  RodInstructions out;
  out.reach_m = reach_m;
  out.seats_m.assign(seats_m.begin(), seats_m.end());
  for (std::size_t k = 0; k < rod.fit.arcs.size(); ++k) {
    const RodArc& arc = rod.fit.arcs[k];
    const auto set_rad = spring_back.set_rad(arc.angle_rad);
    if (!set_rad) {
      return set_rad.error();
    }
    const Vec3 middle_m = rod_place(rod.fit.arcs, arc.centre_m).at_m;
    out.bends.push_back(
        {arc, *set_rad, rod.gaps[k], rod.fit.rod_in_seats_m + rod.fit.seats_from_rod * middle_m});
  }
  out.fit = std::move(rod.fit);
  return out;
}

/// The rod with a bend in every gap that has room for one.
Result<PlannedRod> with_every_bend(std::span<const Vec3> seats_m, const RodBending& bending,
                                   const RodSpringBack& spring_back) {
  const double most_angle_rad = spring_back.most_kept_rad();
  const std::vector<std::size_t> gaps = gaps_for_bends(seats_m, bending);
  constexpr double kNoLimit = std::numeric_limits<double>::infinity();
  auto free = fit_rod_bends(fit_task(seats_m, gaps, bending, kNoLimit));
  if (!free) {
    return free.error();
  }
  if (serves(*free, bending.tolerance_m, most_angle_rad)) {
    return PlannedRod{gaps, *std::move(free)};
  }
  auto limited = fit_rod_bends(fit_task(seats_m, gaps, bending, most_angle_rad));
  if (limited && serves(*limited, bending.tolerance_m, most_angle_rad)) {
    return PlannedRod{gaps, *std::move(limited)};
  }
  return out_of_reach({gaps, *std::move(free)}, seats_m, bending, spring_back);
}

/// Two seats nearer to each other than this are one head touched twice (rod.cpp).
constexpr double kMeeting_m = 0.005;

Status check_length(const char* name, double value_m, double least_m, double most_m) {
  if (!std::isfinite(value_m)) {
    return Error{printed("%s is not finite", name)};
  }
  if (value_m < least_m || value_m > most_m) {
    return Error{printed("%s is %s, limit %g-%g mm", name,
                         in_mm_outside(value_m, least_m, most_m, 2).c_str(), least_m * 1e3,
                         most_m * 1e3)};
  }
  return {};
}

Status check_rod_bending(const RodBending& bending) {
  if (const Status s =
          check_length("overhang of the rod", bending.overhang_m, 0.0, kLongestOverhang_m);
      !s) {
    return s;
  }
  if (const Status s = check_length("width of a tulip", bending.tulip_m, 0.0, kWidestTulip_m); !s) {
    return s;
  }
  if (const Status s =
          check_length("reach of a bend into a tulip", bending.reach_m, 0.0, 0.5 * bending.tulip_m);
      !s) {
    return s;
  }
  return check_length("tolerance at the seats", bending.tolerance_m, kFinestTolerance_m,
                      kCoarsestTolerance_m);
}

Status check_rod_seats(std::span<const Vec3> seats_m) {
  if (seats_m.size() < 2) {
    return Error{printed("rod to bend needs at least 2 seats, got %zu", seats_m.size())};
  }
  for (std::size_t i = 0; i < seats_m.size(); ++i) {
    if (!seats_m[i].is_finite()) {
      return Error{printed("seat %zu of the rod is not finite", i + 1)};
    }
  }
  for (std::size_t i = 1; i < seats_m.size(); ++i) {
    const double gap_m = (seats_m[i] - seats_m[i - 1]).norm();
    if (gap_m < kMeeting_m) {
      return Error{printed("seats %zu and %zu of the rod meet: %s apart, at least 5 mm", i, i + 1,
                           in_mm_outside(gap_m, kMeeting_m, 1.0).c_str())};
    }
  }
  return {};
}

}  // namespace

Result<RodInstructions> rod_instructions(std::span<const Vec3> seats_m, const RodBending& bending) {
  const auto spring_back = RodSpringBack::of(bending.bender, bending.material, bending.diameter_m);
  if (!spring_back) {
    return spring_back.error();
  }
  if (const Status s = check_rod_bending(bending); !s) {
    return s.error();
  }
  if (const Status s = check_rod_seats(seats_m); !s) {
    return s.error();
  }
  // The fit sees tulips that are narrower by what a bend may reach into them.
  RodBending allowed = bending;
  allowed.tulip_m -= 2.0 * bending.reach_m;
  auto rod = with_every_bend(seats_m, allowed, *spring_back);
  if (!rod) {
    return rod.error();
  }
  while (auto less = with_a_bend_less(seats_m, *rod, allowed, spring_back->most_kept_rad())) {
    *rod = *std::move(less);
  }
  const double reach_m = reach_into_tulips_m(*rod, bending);
  return told(*std::move(rod), seats_m, reach_m, *spring_back);
}

}  // namespace orthonav::nav
