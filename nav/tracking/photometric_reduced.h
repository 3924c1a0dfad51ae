#pragma once

#include <array>
#include <span>

#include "nav/tracking/photometric_light.h"

namespace orthonav::nav {

/// A view's equations of the tag's pose, its light eliminated (Schur's complement). What its
/// residuals scatter beyond their noise makes it count less.
struct ReducedView {
  std::array<double, 36> normal{};
  std::array<double, 6> right{};
};
[[nodiscard]] ReducedView reduced(const ViewEquations& equations, const Photometry& light);

/// Back to the light, when the tag's pose makes a step.
[[nodiscard]] LightStep light_step(const ViewEquations& equations, const Photometry& light,
                                   const std::array<double, 6>& of_tag);

/// How much more the pieces of the tag's edges pull at the pose than noise would make them: 1 where
/// the model is right. `scores` are the pulls as of `ViewModel::scores`. (White's sandwich,
/// Econometrica 48, 1980, with a piece of an edge for a cluster, brought to one number.)
[[nodiscard]] double scatter(const ViewEquations& equations, const Photometry& light,
                             std::span<const float> scores);

}  // namespace orthonav::nav
