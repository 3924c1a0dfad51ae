#pragma once

#include <array>
#include <optional>

#include "nav/registration/height_model.h"
#include "nav/statistics/whitened_system.h"

namespace orthonav::nav {

/// Of the scaled unknowns, in which rotations and the size are lengths at a lever arm: what makes
/// them unknowns again.
[[nodiscard]] std::array<double, kHeightUnknowns> unknowns_scale();

/// What whitened heights say of the scaled unknowns together, summed over blocks of units that know
/// nothing of each other.
struct WhitenedSums {
  std::array<double, kHeightUnknowns * kHeightUnknowns> information{};
  std::array<double, kHeightUnknowns> right{};
  double squares = 0.0;
  double log_determinant = 0.0;

  /// `system`: its right-hand sides are the derivatives by the unknowns and, last, the heights.
  void add(const WhitenedSystem& system);
};

/// With the priors of standoff and size. Nothing where a motion is undetermined.
[[nodiscard]] std::optional<HeightModel::Answers> answers_of(const WhitenedSums& sums);

}  // namespace orthonav::nav
