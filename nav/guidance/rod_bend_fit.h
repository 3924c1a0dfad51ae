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

/// A seat against the rod: where its nearest place on the axis lies, and how far it is.
struct SeatOnRod {
  double at_m = 0.0;  ///< along the axis from the first end
  double off_m = 0.0;
};

/// Bends to be found, one in each of the gaps named.
struct RodFitTask {
  std::span<const Vec3> seats_m;   ///< in order along the rod; at least two
  std::span<const RodArc> made;    ///< the first bends are made: they stay as they are
  std::vector<std::size_t> gaps;   ///< of every bend, the made ones first; rising. 0: after seat 0
  double width_m = 0.020;          ///< of a bend
  double tulip_m = 0.010;          ///< of the rod that a tulip holds, where it must be straight
  double overhang_m = 0.005;       ///< wanted beyond the first and the last seat
  std::optional<double> length_m;  ///< of a rod that is cut; absent: as long as it takes
  double most_angle_rad = std::numeric_limits<double>::infinity();
};

struct RodFit {
  std::vector<RodArc> arcs;  ///< the made ones unchanged; of a rod not begun, the first roll is 0
  double length_m = 0.0;
  std::vector<SeatOnRod> seats;
  Mat3 seats_from_rod = Mat3::identity();  ///< the rod's frame (rod_shape.h) in that of the seats
  Vec3 rod_in_seats_m;                     ///< its first end there
  double worst_off_m = 0.0;
  double sharpest_rad = 0.0;    ///< of the bends that were found
  bool clear = false;           ///< no bend reaches into a tulip; a made one 1 mm at most
  double sum_of_squares = 0.0;  ///< of their angles, rad²
};

/// The bends and the place of the rod that bring its axis nearest to the seats; of those that do so
/// equally well the one with the least sum of squared angles. Seats between two bends lie on one
/// straight. `before` is where to begin from: the rod as it was planned. Fails where the numbers
/// run out of what can be calculated.
Result<RodFit> fit_rod_bends(const RodFitTask& task, const RodFit* before = nullptr);

}  // namespace orthonav::nav
