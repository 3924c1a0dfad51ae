#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "engine/study/study.h"
#include "hal/sim/magnitudes.h"

namespace orthonav::engine {

/// How much the mean error of a screw changes when a magnitude goes through its plausible range.
struct Sensitivity {
  std::string magnitude;
  std::string unit;
  double low = 0.0;
  double high = 0.0;
  /// Mean of the absolute elementary effects (Morris's mu*), or, regressed, the change over the
  /// range.
  double entry_mm = 0.0;
  double angle_deg = 0.0;
  /// SD of the effects: large for interactions or a nonlinear effect. Regressed: half width of the
  /// 95 % interval.
  double entry_spread_mm = 0.0;
  double angle_spread_deg = 0.0;
};

struct SensitivityOptions {
  OperationOptions operation;  ///< its seed and the studied magnitudes are replaced
  int trajectories = 4;        ///< of the method
  /// Above 0: instead of that method, a regression over this many random places, with one operation
  /// at each.
  int points = 0;
  int runs = 3;  ///< operations at each point, the same seeds everywhere
  std::uint64_t seed = 1;
  int jobs = 1;
};

/// The magnitudes with a range, except those in which a room differs from `ErrorModel{}`: these are
/// fixed by its profile (a cannula's bending, stated navigation).
[[nodiscard]] std::vector<const sim::Magnitude*> studied_magnitudes(const sim::ErrorModel& own);

/// The method of elementary effects (Morris 1991; mu*: Campolongo 2007) over the ranges of the
/// studied magnitudes (hal/sim/magnitudes.h), the others left as they are. Sorted by what decides
/// entry and angle. `progress`: points done, of all.
Result<std::vector<Sensitivity>> sensitivities(const Case& source,
                                               const SensitivityOptions& options,
                                               const std::function<void(int, int)>& progress = {});

/// Puts the magnitudes with the largest effect on entry and angle first.
void sort_by_effect(std::vector<Sensitivity>& found);

/// A table in Markdown.
[[nodiscard]] std::string sensitivity_table(const std::vector<Sensitivity>& found,
                                            const SensitivityOptions& options);

}  // namespace orthonav::engine
