#include "nav/guidance/rod_bends_check.h"

#include <cmath>
#include <cstddef>

#include "base/length_text.h"
#include "base/printed.h"

namespace orthonav::nav {
namespace {

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

}  // namespace

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

}  // namespace orthonav::nav
