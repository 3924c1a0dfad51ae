#pragma once

#include <array>
#include <span>

#include "nav/tracking/photometric_light.h"

namespace orthonav::nav {

/// A view's equations for the tag's pose, with its light eliminated (Schur complement). Residuals
/// that scatter more than their noise reduce its weight.
struct ReducedView {
  std::array<double, 36> normal{};
  std::array<double, 6> right{};
};
[[nodiscard]] ReducedView reduced(const ViewEquations& equations, const Photometry& light);

/// The step of the light that belongs to a step of the tag's pose.
[[nodiscard]] LightStep light_step(const ViewEquations& equations, const Photometry& light,
                                   const std::array<double, 6>& of_tag);

/// How much more strongly the pieces of the tag's edges pull at the pose than noise alone would: 1
/// if the model is right. `scores` are the pulls, as in `ViewModel::scores`. (White's sandwich,
/// Econometrica 48, 1980, with a piece of an edge as a cluster, reduced to one number.)
[[nodiscard]] double sandwich_factor(const ViewEquations& equations, const Photometry& light,
                                     std::span<const float> scores);

}  // namespace orthonav::nav
