#pragma once

#include <cstddef>
#include <span>

#include "nav/guidance/rod_bend_fit.h"

namespace orthonav::nav {

/// What is expected of a rod that was bent as instructed.
struct RodExpectationRules {
  double limit_m = 0.001;  ///< from the true seats
  /// SD along an axis of what bending adds at a seat. From `study rods`: the farthest of four to
  /// five seats as touched is 0.35 mm off on average, twice the SD that a rigid fit leaves.
  double bending_sd_m = 0.00025;
};

struct RodExpectation {
  /// Probability that every true seat lies within the limit.
  double within = 0.0;
  /// The seat that is most likely to lie beyond it; touching its head again helps most.
  std::size_t least_sure = 0;
};

/// `seat_sd_m` is the SD along an axis of each seat's place, in the order of `fit.seats`. Only what
/// lies across the rod counts, and a rod moves to where it fits best: of n seats' 2n errors it
/// follows four, so that (n - 2) / n of their variance is left. The planned distance of a seat is
/// taken off the limit as if everything else went the same way. Seats are taken as independent.
[[nodiscard]] RodExpectation rod_expectation(const RodFit& fit, std::span<const double> seat_sd_m,
                                             const RodExpectationRules& rules = {});

}  // namespace orthonav::nav
