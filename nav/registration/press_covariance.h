#pragma once

#include <array>

#include "nav/registration/press_fit.h"

namespace orthonav::nav {

/// The covariance of the heights of pressed places with the pose and with each other, without the
/// part that each has alone and without the model's error.
struct PressCovariance {
  std::array<double, 36> before{};  ///< of the pose of the strokes, by rows
  Vec3 centre_m;                    ///< of a step of the pose, in the model's frame
  PressModel press;

  /// The derivative of a height by a step of the pose: the points move in the model's frame about
  /// the centre.
  [[nodiscard]] std::array<double, 6> slope(const PressedHeight& at) const;
  /// The covariance of a height and the pose at the time of its press, including the random walk of
  /// World.
  [[nodiscard]] std::array<double, 6> with_pose(const PressedHeight& at) const;
  [[nodiscard]] double between_m2(const PressedHeight& a, const PressedHeight& b) const;
  /// The covariance of the pose after World has drifted for this long.
  [[nodiscard]] std::array<double, 36> walked(double time_s) const;
};

}  // namespace orthonav::nav
