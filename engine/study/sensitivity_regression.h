#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "engine/study/sensitivity.h"

namespace orthonav::engine {

/// One operation at random values: each magnitude's position in its range (0 to 1), and the mean
/// errors of its screws.
struct RandomPoint {
  std::vector<double> place;
  double entry_mm = 0.0;
  double angle_deg = 0.0;
};

/// Twice the number of unknowns: one for each magnitude, and the mean.
[[nodiscard]] constexpr std::size_t fewest_points(std::size_t magnitudes) {
  return 2 * (magnitudes + 1);
}

/// The effect of each magnitude, by least squares on all of them at once: the change of the mean
/// error over its range, and the half width of its 95 % interval from the scatter of the residuals
/// (heteroscedasticity allowed: White 1980, HC1). Sorted like `sensitivities`. Empty for fewer than
/// `fewest_points`.
[[nodiscard]] std::vector<Sensitivity> regressed(std::span<const sim::Magnitude* const> magnitudes,
                                                 std::span<const RandomPoint> points);

/// Operates once at each of `options.points` random places of the ranges, each with its own seed,
/// and regresses. Operations without a screw are left out. `used`: how many counted. Refuses fewer
/// than `fewest_points` before the first operation, and fails if too few operations placed a screw.
Result<std::vector<Sensitivity>> regressed_sensitivities(
    const Case& source, const SensitivityOptions& options, std::size_t& used,
    const std::function<void(int, int)>& progress = {});

}  // namespace orthonav::engine
