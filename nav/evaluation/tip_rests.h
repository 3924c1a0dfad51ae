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

struct TipRestOptions {
  /// A resting tip stays within this of its own mean: four times a poor tracker's noise.
  double radius_m = 0.005;
  /// It does so for at least so long, in at least so many samples.
  double dwell_s = 0.5;
  std::size_t min_samples = 4;
  /// A longer time without a sample ends a rest.
  double max_gap_s = 1.0;
  /// So many samples in a row may lie elsewhere without ending it; they are left out.
  std::size_t max_outliers = 2;
  /// Arriving and leaving: left out at either end, but no more than a third of the rest each.
  double settle_s = 0.15;
};

struct TipRest {
  std::vector<std::size_t> samples;  ///< indices, rising; not empty
  Vec3 mean_m{};
};

/// Every rest, in the order of time (dispersion threshold, as Salvucci and Goldberg 2000 find the
/// eye's fixations). Rests in a row at the same place (a tag that was hidden, a tip put back) are
/// one. The samples' times must increase.
[[nodiscard]] std::vector<TipRest> tip_rests(std::span<const TipSample> samples,
                                             const TipRestOptions& options);

}  // namespace orthonav::nav
