#pragma once

#include <array>

#include "nav/tracking/photometric_view.h"

namespace orthonav::nav {

/// One entry per light column of `ViewEquations`.
using LightStep = std::array<double, kLightColumns>;

/// Weak beliefs about the light, so that a view without white cells, or without edges, stays
/// solvable: what they add to the diagonal of its normal equations and to their right-hand side.
struct LightPrior {
  LightStep weight{};
  LightStep right{};
};
[[nodiscard]] LightPrior light_prior(const Photometry& light);

/// Changes the light by a step, within physical limits of light and lenses.
void apply(const LightStep& step, double px_a_cell, Photometry& light);

/// Updates noise and scatter about the model: `fraction` of the remembered value comes from these
/// residuals.
void learn_noise(const ViewEquations& equations, double fraction, Photometry& light);

}  // namespace orthonav::nav
