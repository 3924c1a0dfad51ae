#include "hal/sim/cameras/imperfect.h"

#include <cmath>
#include <string>

#include "hal/sim/surgeon/grip.h"

namespace orthonav::sim {
namespace {

/// Pixels per unit of the unit plane in the middle of the image.
Result<double> focal_px(const CameraModel& camera) {
  const auto jacobian = camera.jacobian_px({0.5 * camera.width_px(), 0.5 * camera.height_px()});
  if (!jacobian) {
    return Error{"simulated camera: no viewing ray in the middle of the image"};
  }
  const auto& j = *jacobian;
  return std::sqrt(std::abs(j[0] * j[3] - j[1] * j[2]));
}

Result<CameraModel> perturbed(const CameraModel& camera, const ErrorModel& error_model,
                              Random random) {
  const double zoom = 1.0 + random.normal(0.0, error_model.calibration_focal_ratio);
  const double right_px = random.normal(0.0, error_model.calibration_centre_px);
  const double down_px = random.normal(0.0, error_model.calibration_centre_px);
  const double corner_px = random.normal(0.0, error_model.calibration_distortion_px);
  if (zoom == 1.0 && right_px == 0.0 && down_px == 0.0 && corner_px == 0.0) {
    return camera;
  }
  const auto focal = focal_px(camera);
  if (!focal) {
    return focal.error();
  }
  std::vector<Vec2> rays(camera.lookup().begin(), camera.lookup().end());
  const double half_px = 0.5 * std::hypot(camera.width_px(), camera.height_px());
  const double corner = half_px / *focal;
  for (Vec2& ray : rays) {
    const double squared = ray.dot(ray) / (corner * corner);
    const double radial = 1.0 + corner_px / half_px * squared;
    ray = (radial / zoom) * (ray - Vec2{right_px / *focal, down_px / *focal});
  }
  return CameraModel::from_lookup(camera.width_px(), camera.height_px(), std::move(rays));
}

}  // namespace

Result<StereoCalibration> perturbed(const StereoCalibration& reported,
                                    const ErrorModel& error_model, const Random& random) {
  auto left = perturbed(reported.left, error_model, random.fork("left camera"));
  if (!left) {
    return left.error();
  }
  auto right = perturbed(reported.right, error_model, random.fork("right camera"));
  if (!right) {
    return right.error();
  }
  StereoCalibration actual = reported;
  actual.left = std::move(left).value();
  actual.right = std::move(right).value();
  Random rig = random.fork("rig");
  const Vec3 rotation_rad = normal_vector(rig, error_model.calibration_rotation_rad);
  const Vec3 offset_m = normal_vector(rig, error_model.calibration_baseline_m);
  const auto& nominal = reported.right_from_rig;
  if (rotation_rad == Vec3{} && offset_m == Vec3{}) {
    return actual;
  }
  // About the right camera's own centre, which only the offset moves.
  const Mat3 rotation = rotation_from_vector(rotation_rad) * nominal.rotation();
  const Vec3 centre = nominal.inverse().translation() + offset_m;
  actual.right_from_rig = {rotation, -(rotation * centre)};
  return actual;
}

std::vector<RoomTool> described(const std::vector<RoomTool>& tools, const ErrorModel& error_model,
                                const Random& random) {
  std::vector<RoomTool> descriptions = tools;
  for (std::size_t i = 0; i < tools.size(); ++i) {
    Random noise = random.fork(i);
    RoomTool& tool = descriptions[i];
    tool.tip_in_marker = tool.tip_in_marker + normal_vector(noise, error_model.tip_calibration_m);
    const Vec3 tilt = normal_vector(noise, error_model.axis_calibration_rad);
    const Vec3 axis = tool.axis_in_marker;
    tool.axis_in_marker = (rotation_from_vector(tilt - tilt.dot(axis) * axis) * axis).normalized();
    tool.size_m *= 1.0 + noise.normal(0.0, error_model.tag_scale);
  }
  return descriptions;
}

}  // namespace orthonav::sim
