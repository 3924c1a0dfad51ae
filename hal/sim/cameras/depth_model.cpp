#include "hal/sim/cameras/depth_model.h"

#include <cmath>

#include "hal/api/brown_conrady.h"

namespace orthonav::sim {
namespace {

/// Between the front cameras, in Rig.
constexpr Vec3 kPlaceInRig{0.048, 0.011, -0.006};

/// Looks forward and down by `down_rad`; raw images are upright except for a small turn.
Transform<DepthSensor, Rig> looking_down(double down_rad, double roll_rad) {
  const double c = std::cos(down_rad);
  const double s = std::sin(down_rad);
  const Mat3 axes = {{{{1, 0, 0}, {0, -c, s}, {0, -s, -c}}}};
  const Mat3 rotation = rotation_from_vector({0.0, 0.01, roll_rad}) * axes;
  return {rotation, -(rotation * kPlaceInRig)};
}

/// Outside this circle of unit-plane directions the lens images nothing.
double rim_of(const BrownConrady& lens) { return 0.53 * lens.width_px / lens.fx_px; }

}  // namespace

DepthModel hololens2_ahat() {
  return {DepthStream::kAhat,
          {512, 512, 188.0, 187.2, 259.3, 252.1, -0.030, 0.004, 0.0003, -0.0002, 0.0},
          looking_down(0.32, 0.015),
          45.0,
          1.055,
          3.0};
}

DepthModel hololens2_long_throw() {
  return {DepthStream::kLongThrow,
          {320, 288, 209.0, 208.3, 163.7, 141.9, -0.020, 0.003, -0.0002, 0.0003, 0.0},
          looking_down(0.25, -0.012),
          5.0,
          0.0,
          7.5};
}

DepthCalibration calibration_of(const DepthModel& model) {
  DepthCalibration calibration;
  calibration.stream = model.stream;
  calibration.width_px = model.lens.width_px;
  calibration.height_px = model.lens.height_px;
  calibration.sensor_from_rig = model.sensor_from_rig;
  calibration.wraps_at_m = model.wraps_at_m;
  const double rim = rim_of(model.lens);
  for (int y = 0; y < calibration.height_px; ++y) {
    for (int x = 0; x < calibration.width_px; ++x) {
      const Vec2 unit_plane = undistorted(model.lens, {x + 0.5, y + 0.5});
      const bool seen = unit_plane.norm() <= rim;  // false for NaN
      calibration.rays.push_back(seen ? DepthCalibration::ray_through(unit_plane)
                                      : DepthCalibration::Ray{});
    }
  }
  return calibration;
}

}  // namespace orthonav::sim
