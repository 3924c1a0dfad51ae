#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "nav/evaluation/tip_rests.h"

namespace orthonav::nav {

/// Distances of tips from their mean. All zero without tips.
struct TipSpread {
  std::size_t samples = 0;
  Vec3 mean_m{};
  double rms_m = 0.0;
  double p95_m = 0.0;  ///< nearest rank
  double max_m = 0.0;
};
[[nodiscard]] TipSpread tip_spread(std::span<const TipSample> samples);

/// A tip that moved from one place to another at some moment.
struct TipSlip {
  double time_s = 0.0;
  double step_m = 0.0;
};

/// The largest difference between the mean tips before and after a moment, with at least a second
/// of samples on either side, if it exceeds `max_step_m` and four times what the scatter of
/// quarters of a second would explain. The samples' times must increase.
[[nodiscard]] std::optional<TipSlip> tip_slip(std::span<const TipSample> samples,
                                              double max_step_m);

}  // namespace orthonav::nav
