#pragma once

#include <array>

#include "nav/tracking/photometric_view.h"

namespace orthonav::nav {

/// One entry per light column of `ViewEquations`.
using LightStep = std::array<double, kLightColumns>;

/// Weak priors on the light, which keep a view without white cells or without edges solvable: their
/// additions to the diagonal of the view's normal equations and to the right-hand side.
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
