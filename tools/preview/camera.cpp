#include "tools/preview/camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace orthonav::preview {
namespace {

/// The wound is this far in front of the eyes.
constexpr double kArm_m = 0.45;
constexpr double kNearest_m = 0.05;
constexpr double kFarthest_m = 5.0;
constexpr double kMaxMagnification = 6.0;
constexpr double kZoomStep = 1.1;
/// Dragging by the picture's height turns by this angle.
constexpr double kRotationPerHeight_rad = std::numbers::pi;
/// Looking straight down there is no upright.
constexpr double kSteepest_rad = 1.55;

}  // namespace

void Camera::start_orbit(const Transform<sim::Room, Eye>& stage_from_eye) {
  const Vec3 gaze = -stage_from_eye.rotation().column(2);
  orbits_ = true;
  distance_m_ = kArm_m;
  focus_ = stage_from_eye.translation() + kArm_m * gaze;
  yaw_rad_ = std::atan2(-gaze.x, -gaze.z);
  pitch_rad_ = std::clamp(std::asin(std::clamp(-gaze.y, -1.0, 1.0)), -kSteepest_rad, kSteepest_rad);
}

void Camera::orbit(Vec2 by) {
  if (!orbits_) {
    return;
  }
  yaw_rad_ = std::remainder(yaw_rad_ - kRotationPerHeight_rad * by.x, 2.0 * std::numbers::pi);
  pitch_rad_ =
      std::clamp(pitch_rad_ + kRotationPerHeight_rad * by.y, -kSteepest_rad, kSteepest_rad);
}

void Camera::pan(Vec2 by) {
  if (!orbits_) {
    return;
  }
  const Mat3 axes = stage_from_eye().rotation();
  focus_ += distance_m_ * (by.y * axes.column(1) - by.x * axes.column(0));
}

void Camera::zoom(double steps) {
  const double factor = std::pow(kZoomStep, steps);
  if (orbits_) {
    distance_m_ = std::clamp(distance_m_ / factor, kNearest_m, kFarthest_m);
  } else {
    magnification_ = std::clamp(magnification_ * factor, 1.0, kMaxMagnification);
  }
}

Transform<sim::Room, Eye> Camera::stage_from_eye() const {
  const Mat3 rotation =
      rotation_from_vector({0.0, yaw_rad_, 0.0}) * rotation_from_vector({-pitch_rad_, 0.0, 0.0});
  return {rotation, focus_ + distance_m_ * rotation.column(2)};
}

}  // namespace orthonav::preview
