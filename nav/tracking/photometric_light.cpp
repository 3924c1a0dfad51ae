#include "nav/tracking/photometric_light.h"

#include <algorithm>
#include <cmath>

namespace orthonav::nav {
namespace {

constexpr double kBlurFloorPx = 0.25;
constexpr double kBlurCeilingCells = 0.6;
/// Largest change at once of a logarithm of blur, or of a fraction of grey.
constexpr double kLargestLightStep = 0.5;
constexpr double kVarianceFloor = 0.3;
/// With fewer black or white pixels, their noise is not updated.
constexpr double kFewestFractions = 20.0;
/// Neither black nor white gets less than this fraction of the mean noise.
constexpr double kLeastOfMean = 0.25;

double bounded(double v, double limit) { return std::clamp(v, -limit, limit); }

}  // namespace

LightPrior light_prior(const Photometry& light) {
  LightPrior prior;
  const auto step = [&](std::size_t i, double sd) { prior.weight[i] = 1.0 / (sd * sd); };
  const auto about_zero = [&](std::size_t i, double value, double sd) {
    step(i, sd);
    prior.right[i] = -value / (sd * sd);
  };
  step(0, 500.0);
  step(1, 500.0);
  about_zero(2, light.slope[0], 0.3);
  about_zero(3, light.slope[1], 0.3);
  step(4, 0.5);
  step(5, 0.5);
  about_zero(6, light.excess_kurtosis[0], 1.0);
  about_zero(7, light.excess_kurtosis[1], 1.0);
  about_zero(8, light.blur_correlation, 0.3);
  for (std::size_t i = 0; i < light.response.size(); ++i) {
    about_zero(9 + i, light.response[i], 0.5);
  }
  return prior;
}

void apply(const LightStep& step, double px_a_cell, Photometry& light) {
  light.black += bounded(step[0], 100.0);
  light.contrast = std::clamp(light.contrast + bounded(step[1], 150.0), 5.0, 400.0);
  for (std::size_t i = 0; i < 2; ++i) {
    light.slope[i] = std::clamp(light.slope[i] + step[2 + i], -0.8, 0.8);
    light.blur_cells[i] =
        std::clamp(light.blur_cells[i] * std::exp(bounded(step[4 + i], kLargestLightStep)),
                   kBlurFloorPx / px_a_cell, kBlurCeilingCells);
    light.excess_kurtosis[i] =
        std::clamp(light.excess_kurtosis[i] + bounded(step[6 + i], 1.0), -1.2, 3.0);
  }
  light.blur_correlation = std::clamp(light.blur_correlation + bounded(step[8], 0.5), -0.8, 0.8);
  // Stays well away from where the response would no longer rise everywhere.
  for (std::size_t i = 0; i < light.response.size(); ++i) {
    light.response[i] = std::clamp(light.response[i] + bounded(step[9 + i], 0.3), -0.9, 0.9);
  }
}

void learn_noise(const ViewEquations& e, double fraction, Photometry& light) {
  // Inverses are averaged, since an occasional pair has a large value.
  if (e.sandwich_factor > 0.0) {
    light.sandwich_factor =
        1.0 / ((1.0 - fraction) / light.sandwich_factor + fraction / e.sandwich_factor);
  }
  if (e.edge_fractions > 0.0) {
    light.edge_variance = (1.0 - fraction) * light.edge_variance +
                          fraction * std::max(e.edge_squares / e.edge_fractions, 0.0);
  }
  const auto [black, both, white] = e.fractions;
  const double determinant = black * white - both * both;
  if (black < kFewestFractions || white < kFewestFractions || !(determinant > 0.0)) {
    return;
  }
  const double mean = (e.squares[0] + e.squares[1]) / (black + 2.0 * both + white);
  const std::array<double, 2> solved{(white * e.squares[0] - both * e.squares[1]) / determinant,
                                     (black * e.squares[1] - both * e.squares[0]) / determinant};
  for (std::size_t side = 0; side < 2; ++side) {
    const double found = std::max(solved[side], kLeastOfMean * mean) / kRobustVariance;
    light.variance[side] =
        std::max(kVarianceFloor, (1.0 - fraction) * light.variance[side] + fraction * found);
  }
}

}  // namespace orthonav::nav
