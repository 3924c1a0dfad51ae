#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/vec.h"

namespace orthonav::nav {

struct TipSample {
  double time_s = 0.0;
  Vec3 tip_m{};
};

/// A resting tip stays within this distance of its own mean: four times a poor tracker's noise.
inline constexpr double kRestRadius_m = 0.005;
/// A longer time without a sample ends a rest.
inline constexpr double kLongestGap_s = 1.0;
/// Approach and departure: left out at either end, but no more than a third of the rest each.
inline constexpr double kSettle_s = 0.15;

struct TipRest {
  std::vector<std::size_t> samples;  ///< indices, ascending; not empty
  Vec3 mean_m{};
};

/// Every rest, in the order of time (dispersion threshold, as Salvucci and Goldberg 2000 find
/// fixations of the eye). Consecutive rests at the same place (the tag was hidden, or the tip was
/// put back) count as one. The samples' times must increase.
[[nodiscard]] std::vector<TipRest> tip_rests(std::span<const TipSample> samples);

}  // namespace orthonav::nav
