#pragma once

#include <Eigen/Core>
#include <span>

#include "nav/tracking/photometric_light.h"

namespace orthonav::nav {

/// A view's equations of the tag's pose, its light eliminated (Schur's complement). What its
/// residuals scatter beyond their noise makes it count less.
struct ReducedView {
  Eigen::Matrix<double, 6, 6> normal;
  Eigen::Matrix<double, 6, 1> right;
};
[[nodiscard]] ReducedView reduced(const ViewEquations& equations, const Photometry& light);

/// Back to the light, when the tag's pose makes a step.
[[nodiscard]] LightStep light_step(const ViewEquations& equations, const Photometry& light,
                                   const Eigen::Matrix<double, 6, 1>& of_tag);

/// How much more the pieces of the tag's edges pull at the pose than noise would make them: 1 where
/// the model is right. `scores` are the pulls as of `ViewModel::scores`. (White's sandwich,
/// Econometrica 48, 1980, with a piece of an edge for a cluster, brought to one number.)
[[nodiscard]] double scatter(const ViewEquations& equations, const Photometry& light,
                             std::span<const float> scores);

}  // namespace orthonav::nav
