#pragma once

#include <array>

#include "nav/registration/press_fit.h"

namespace orthonav::nav {

/// The covariance of the heights of pressed places with the pose and with each other, without the
/// part that each has alone and without the model's error.
struct PressCovariance {
  std::array<double, 36> before{};  ///< of the pose of the strokes, by rows, without the model's
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

/// The same of the model's error, of SD 1: a height changes by it where it was measured, and with
/// the pose of the strokes, which it moved.
class FieldCovariance {
 public:
  /// `length_m` of the error. Keeps a reference to `strokes`.
  FieldCovariance(const ModelShare& strokes, double length_m, Vec3 centre_m);

  /// Of the pose of the strokes, by rows.
  [[nodiscard]] const std::array<double, 36>& pose() const { return pose_; }
  /// Of that pose and the model's error at a place.
  [[nodiscard]] std::array<double, 6> with_place(Vec3 at_m) const;
  /// Of a height and the pose, with the sign of `PressCovariance::with_pose`; `place`: `with_place`
  /// there.
  [[nodiscard]] std::array<double, 6> with_pose(const PressedHeight& at,
                                                const std::array<double, 6>& place) const;
  [[nodiscard]] double between(const PressedHeight& a, const std::array<double, 6>& place_a,
                               const PressedHeight& b, const std::array<double, 6>& place_b) const;

 private:
  const ModelShare& strokes_;
  double length_m_;
  Vec3 centre_m_;
  std::array<double, 36> pose_{};
};

}  // namespace orthonav::nav
