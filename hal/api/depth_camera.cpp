#include "hal/api/depth_camera.h"

#include <cmath>
#include <string>

namespace orthonav {

namespace {

constexpr double kMetresAMillimetre = 1e-3;

Status check_images(const std::string& what, const DepthFrame& frame,
                    const DepthCalibration& camera) {
  const auto check = [&](const char* which, const DepthImage& image) {
    return check_size(what, which, image, camera.width_px, camera.height_px);
  };
  if (Status s = check("range", frame.range_mm); !s) {
    return s;
  }
  const bool absent = frame.brightness == DepthImage();
  return absent ? Status() : check("brightness", frame.brightness);
}

}  // namespace

const char* name_of(DepthStream stream) {
  switch (stream) {
    case DepthStream::kAhat:
      return "ahat";
    case DepthStream::kLongThrow:
      return "long-throw";
    case DepthStream::kShortThrow:
      return "short-throw";
  }
  return "unknown stream";
}

DepthCalibration::Ray DepthCalibration::ray_through(Vec2 unit_plane) {
  if (!std::isfinite(unit_plane.x) || !std::isfinite(unit_plane.y)) {
    return {};
  }
  const Vec3 ray = Vec3{unit_plane.x, unit_plane.y, 1.0}.normalized();
  return {static_cast<float>(ray.x), static_cast<float>(ray.y), static_cast<float>(ray.z)};
}

std::optional<Point<DepthSensor>> DepthCalibration::point_at(int x_px, int y_px,
                                                             std::uint16_t range_mm) const {
  const Ray& ray = rays[static_cast<std::size_t>(y_px) * static_cast<std::size_t>(width_px) +
                        static_cast<std::size_t>(x_px)];
  if (range_mm == 0 || ray[2] == 0.0F) {
    return std::nullopt;
  }
  const Vec3 direction{ray[0], ray[1], ray[2]};
  return Point<DepthSensor>{kMetresAMillimetre * range_mm * direction};
}

void DepthFrame::clear() {
  range_mm.clear();
  brightness.clear();
  sequence = -1;
  world_from_rig.reset();
}

Result<Next> DepthCamera::next(DepthFrame& frame) {
  const std::string what = std::string("depth ") + name_of(calibration().stream);
  return order_.next(
      what, frame, [&] { return do_next(frame); },
      [&] { return check_images(what, frame, calibration()); });
}

}  // namespace orthonav
