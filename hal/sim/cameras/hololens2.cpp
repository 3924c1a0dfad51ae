#include "hal/sim/cameras/hololens2.h"

namespace orthonav::sim {
namespace {

constexpr int kWidthPx = 640;
constexpr int kHeightPx = 480;
constexpr double kBaselineM = 0.099;
/// The right camera sits a few millimetres deeper in the visor.
constexpr double kRightForwardM = 0.003;
/// In real units the cameras are turned by one or two degrees relative to each other about each
/// axis.
constexpr Vec3 kRightRotation_rad{0.010, -0.008, 0.020};

StereoCalibration made() {
  StereoCalibration calibration;
  // Constants whose validity is tested; a refusal here would be our own bug.
  calibration.left = CameraModel::from_brown_conrady(hololens2_left()).value();
  calibration.right = CameraModel::from_brown_conrady(hololens2_right()).value();
  const Mat3 left_axes = {{{{0, 1, 0}, {1, 0, 0}, {0, 0, -1}}}};
  const Mat3 right_axes = {{{{0, -1, 0}, {-1, 0, 0}, {0, 0, -1}}}};
  calibration.left_from_rig = {left_axes, {}};
  const Mat3 right_rotation = rotation_from_vector(kRightRotation_rad) * right_axes;
  const Vec3 right_in_rig{kBaselineM, 0.0, -kRightForwardM};
  calibration.right_from_rig = {right_rotation, -(right_rotation * right_in_rig)};
  return calibration;
}

}  // namespace

BrownConrady hololens2_left() {
  return {kWidthPx, kHeightPx, 362.0, 362.5, 312.0, 237.0, -0.040, 0.012, 0.0004, -0.0003, 0.0};
}

BrownConrady hololens2_right() {
  return {kWidthPx, kHeightPx, 360.0, 360.5, 327.0, 244.0, -0.041, 0.013, -0.0003, 0.0005, 0.0};
}

const StereoCalibration& hololens2_calibration() {
  static const StereoCalibration calibration = made();
  return calibration;
}

}  // namespace orthonav::sim
