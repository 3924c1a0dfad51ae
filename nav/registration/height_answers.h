#pragma once

#include <array>
#include <optional>

#include "nav/registration/height_model.h"
#include "nav/statistics/whitened_system.h"

namespace orthonav::nav {

/// The factors that turn scaled unknowns, in which rotations and size are lengths at a lever arm,
/// back into the unknowns.
[[nodiscard]] std::array<double, kHeightUnknowns> unknowns_scale();

/// The normal equations of the whitened heights for the scaled unknowns, summed over blocks of
/// units that are uncorrelated with each other.
struct WhitenedSums {
  std::array<double, kHeightUnknowns * kHeightUnknowns> information{};
  std::array<double, kHeightUnknowns> right{};
  double squares = 0.0;
  double log_determinant = 0.0;

  /// The right-hand sides of `system` are the derivatives by the unknowns and, last, the heights.
  void add(const WhitenedSystem& system);
};

/// The solution, with the priors of standoff and size. Empty if a motion is undetermined.
[[nodiscard]] std::optional<HeightModel::Answers> answers_of(const WhitenedSums& sums);

}  // namespace orthonav::nav
