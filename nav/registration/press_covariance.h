#pragma once

#include <array>

#include "nav/registration/press_fit.h"

namespace orthonav::nav {

/// How the heights of pressed places vary with the pose and with each other, but for what each has
/// alone and for the model's error.
struct PressCovariance {
  std::array<double, 36> before{};  ///< of the pose of the strokes, by rows
  Vec3 centre_m;                    ///< of a step of the pose, in the model's frame
  PressModel press;

  /// Of a height, by a step of the pose: the points move in the model's frame about the centre.
  [[nodiscard]] std::array<double, 6> slope(const PressedHeight& at) const;
  /// Of a height and the pose at the time of its press, the random walk of World among it.
  [[nodiscard]] std::array<double, 6> with_pose(const PressedHeight& at) const;
  [[nodiscard]] double between_m2(const PressedHeight& a, const PressedHeight& b) const;
  /// Of the pose, once World walked for so long.
  [[nodiscard]] std::array<double, 36> walked(double time_s) const;
};

}  // namespace orthonav::nav
