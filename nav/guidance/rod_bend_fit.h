#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "base/result.h"
#include "base/vec.h"
#include "nav/guidance/rod_shape.h"

namespace orthonav::nav {

/// A seat relative to the rod: where on the axis its nearest point lies, and how far away it is.
struct SeatOnRod {
  double at_m = 0.0;  ///< along the axis from the first end
  double off_m = 0.0;
};

/// Bends to be found, one in each of the gaps named.
struct RodFitTask {
  std::span<const Vec3> seats_m;  ///< in order along the rod; at least two
  std::vector<std::size_t> gaps;  ///< of each bend, ascending; 0: after seat 0
  double width_m = 0.020;         ///< of a bend
  double tulip_m = 0.010;         ///< of the rod that a tulip holds, where it must be straight
  double overhang_m = 0.005;      ///< wanted beyond the first and the last seat
  double most_angle_rad = std::numeric_limits<double>::infinity();
};

struct RodFit {
  std::vector<RodArc> arcs;  ///< the first with roll 0
  double length_m = 0.0;
  std::vector<SeatOnRod> seats;
  Mat3 seats_from_rod = Mat3::identity();  ///< the rod's frame (rod_shape.h) in that of the seats
  Vec3 rod_in_seats_m;                     ///< its first end there
  double worst_off_m = 0.0;
  double sharpest_rad = 0.0;    ///< of the bends that were found
  bool clear = false;           ///< no bend reaches into a tulip
  double sum_of_squares = 0.0;  ///< of their angles, rad²
};

/// The bends and the position of the rod that bring its axis nearest to the seats; among equally
/// good ones, those with the least sum of squared angles. Seats between two bends lie on one
/// straight. `before` is the start of the search: the rod as planned. Fails if the calculation
/// leaves the range of finite numbers.
Result<RodFit> fit_rod_bends(const RodFitTask& task);

}  // namespace orthonav::nav
