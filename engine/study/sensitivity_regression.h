#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "engine/study/sensitivity.h"

namespace orthonav::engine {

/// One operation at a random place of the ranges: the places of the magnitudes in theirs (0 to 1),
/// and the mean errors of its screws.
struct RandomPoint {
  std::vector<double> place;
  double entry_mm = 0.0;
  double angle_deg = 0.0;
};

/// Twice as many as there are unknowns: one of each magnitude, and the mean.
[[nodiscard]] constexpr std::size_t fewest_points(std::size_t magnitudes) {
  return 2 * (magnitudes + 1);
}

/// What each magnitude does, by least squares on all of them at once: the change of the mean error
/// over its range, and the half width of its 95 % interval from the scatter of the residuals
/// (heteroscedasticity allowed: White 1980, HC1). Sorted like `sensitivities`. Fewer than
/// `fewest_points` tell nothing: empty.
[[nodiscard]] std::vector<Sensitivity> regressed(std::span<const sim::Magnitude* const> magnitudes,
                                                 std::span<const RandomPoint> points);

/// Operates once at each of `options.points` random places of the ranges, each with a seed of its
/// own, and regresses. Operations without a screw are left out. `used`: how many counted. Refuses
/// fewer than `fewest_points`, before the first operation, and where too few of them placed a
/// screw.
Result<std::vector<Sensitivity>> regressed_sensitivities(
    const Case& source, const SensitivityOptions& options, std::size_t& used,
    const std::function<void(int, int)>& progress = {});

}  // namespace orthonav::engine
