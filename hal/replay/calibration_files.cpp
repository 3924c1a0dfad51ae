#include "hal/replay/calibration_files.h"

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "hal/replay/layout.h"
#include "hal/replay/text.h"

namespace orthonav::replay {

namespace {

static_assert(std::endian::native == std::endian::little, "look-up files are little-endian");

constexpr std::size_t kRayBytes = 3 * sizeof(float);
constexpr std::size_t kExactBytes = 2 * sizeof(double);
// A single-precision ray is a unit vector within 1e-7; a larger deviation is not a ray.
constexpr double kUnitTolerance = 1e-3;
// Single-precision rays determine the unit plane to about 1e-7 (1 + r²) / z; a much larger
// difference means another camera's table.
constexpr double kAgreement = 1e-5;

/// How large a table is.
struct Size {
  int width_px = 0;
  int height_px = 0;
  [[nodiscard]] std::size_t pixels() const {
    return static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px);
  }
};
constexpr Size kFrontCamera{kImageWidthPx, kImageHeightPx};

std::string pixel_text(std::size_t index, Size size) {
  const auto width = static_cast<std::size_t>(size.width_px);
  return "ray of pixel (" + std::to_string(index % width) + ", " + std::to_string(index / width) +
         ")";
}

/// Refuses a ray that is not a unit vector pointing ahead.
Status check_ray(const DepthCalibration::Ray& single) {
  const Vec3 ray{single[0], single[1], single[2]};
  if (!ray.is_finite()) {
    return Error{"is not finite"};
  }
  if (std::abs(ray.norm() - 1.0) > kUnitTolerance) {
    return Error{"has length " + std::to_string(ray.norm()) + ", must be 1 within " +
                 std::to_string(kUnitTolerance)};
  }
  if (ray.z < 0.0) {
    return Error{"has z " + std::to_string(ray.z) + ", must point ahead (z > 0)"};
  }
  return {};
}

/// Rays of pixels without a direction are returned as zeros: with z = 0 the recorder leaves x and y
/// uninitialized.
Result<std::vector<DepthCalibration::Ray>> read_rays(const std::filesystem::path& path, Size size) {
  const auto bytes = read_sized(path, size.pixels() * kRayBytes);
  if (!bytes) {
    return bytes.error();
  }
  std::vector<DepthCalibration::Ray> rays(size.pixels());
  for (std::size_t i = 0; i < rays.size(); ++i) {
    DepthCalibration::Ray ray{};
    std::memcpy(ray.data(), bytes->data() + i * kRayBytes, kRayBytes);
    if (ray[2] == 0.0F) {
      continue;
    }
    if (Status s = check_ray(ray); !s) {
      return file_error(path, pixel_text(i, size) + " " + s.error().message);
    }
    rays[i] = ray;
  }
  return rays;
}

Result<std::vector<Vec2>> read_unit_plane(const std::filesystem::path& path) {
  const auto rays = read_rays(path, kFrontCamera);
  if (!rays) {
    return rays.error();
  }
  constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
  std::vector<Vec2> unit_plane;
  unit_plane.reserve(rays->size());
  for (const auto& [x, y, z] : *rays) {
    unit_plane.push_back(z == 0.0F ? Vec2{kNothing, kNothing}
                                   : Vec2{double{x} / double{z}, double{y} / double{z}});
  }
  return unit_plane;
}

/// The same table in double precision, which must agree with the rays.
Result<std::vector<Vec2>> read_exact(const std::filesystem::path& path,
                                     const std::vector<Vec2>& rays) {
  const auto bytes = read_sized(path, kExactBytes * kImageBytes);
  if (!bytes) {
    return bytes.error();
  }
  std::vector<Vec2> unit_plane(kImageBytes);
  for (std::size_t i = 0; i < kImageBytes; ++i) {
    std::array<double, 2> pair{};
    std::memcpy(pair.data(), bytes->data() + i * kExactBytes, kExactBytes);
    const Vec2 exact{pair[0], pair[1]};
    unit_plane[i] = exact;
    if (std::isnan(rays[i].x) && std::isnan(exact.x) && std::isnan(exact.y)) {
      continue;
    }
    const double limit = kAgreement * (1.0 + rays[i].dot(rays[i]));
    if (!((exact - rays[i]).norm() <= limit)) {
      return file_error(
          path, pixel_text(i, kFrontCamera) + " disagrees with the one in the _lut.bin beside it");
    }
  }
  return unit_plane;
}

Result<CameraModel> read_camera(const std::filesystem::path& folder, const std::string& sensor) {
  auto table = read_unit_plane(lut_of(folder, sensor));
  if (!table) {
    return table.error();
  }
  const auto exact_path = exact_lut_of(folder, sensor);
  std::error_code code;
  if (std::filesystem::exists(exact_path, code)) {
    table = read_exact(exact_path, *table);
    if (!table) {
      return table.error();
    }
  }
  auto camera = CameraModel::from_lookup(kImageWidthPx, kImageHeightPx, std::move(*table));
  if (!camera) {
    return file_error(lut_of(folder, sensor), camera.error().message);
  }
  return camera;
}

template <class Camera>
Result<Transform<Camera, Rig>> read_extrinsics(const std::filesystem::path& path) {
  constexpr std::uintmax_t kMaxBytes = 4096;
  auto text = read_text(path, kMaxBytes);
  if (!text) {
    return text.error();
  }
  while (!text->empty() && std::isspace(static_cast<unsigned char>(text->back()))) {
    text->pop_back();
  }
  std::vector<std::string_view> fields;
  split(*text, fields);
  if (fields.size() != 16) {
    return file_error(
        path, "camera_from_rig holds " + std::to_string(fields.size()) + " numbers, must be 16");
  }
  auto pose = parse_pose<Camera, Rig>(fields, 0, kMaxExtrinsics_m);
  if (!pose) {
    return file_error(path, "camera_from_rig: " + pose.error().message);
  }
  return pose;
}

template <class Number>
Status write_numbers(const std::filesystem::path& path, const std::vector<Number>& numbers) {
  return write_bytes(
      path, {reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number)});
}

Status write_camera(const std::filesystem::path& folder, const std::string& sensor,
                    const CameraModel& camera) {
  if (camera.width_px() != kImageWidthPx || camera.height_px() != kImageHeightPx) {
    return Error{"recording: camera " + sensor + " is " + std::to_string(camera.width_px()) + "x" +
                 std::to_string(camera.height_px()) + " px, must be 640x480"};
  }
  std::vector<float> rays;
  std::vector<double> exact;
  rays.reserve(3 * kImageBytes);
  exact.reserve(2 * kImageBytes);
  for (const Vec2 p : camera.lookup()) {
    const DepthCalibration::Ray ray = DepthCalibration::ray_through(p);
    rays.insert(rays.end(), ray.begin(), ray.end());
    exact.push_back(p.x);
    exact.push_back(p.y);
  }
  if (Status status = write_numbers(lut_of(folder, sensor), rays); !status) {
    return status;
  }
  return write_numbers(exact_lut_of(folder, sensor), exact);
}

Status write_extrinsics(const std::filesystem::path& path, const std::array<double, 16>& matrix) {
  std::string text;
  for (std::size_t i = 0; i < 16; ++i) {
    if (i > 0) {
      text += ',';
    }
    append_number(text, matrix[i]);
  }
  text += '\n';
  return write_bytes(path, text);
}

}  // namespace

Result<StereoCalibration> read_calibration(const std::filesystem::path& folder) {
  auto left = read_camera(folder, kLeftSensor);
  if (!left) {
    return left.error();
  }
  auto right = read_camera(folder, kRightSensor);
  if (!right) {
    return right.error();
  }
  const auto left_from_rig = read_extrinsics<LeftCamera>(extrinsics_of(folder, kLeftSensor));
  if (!left_from_rig) {
    return left_from_rig.error();
  }
  const auto right_from_rig = read_extrinsics<RightCamera>(extrinsics_of(folder, kRightSensor));
  if (!right_from_rig) {
    return right_from_rig.error();
  }
  return StereoCalibration{std::move(*left), std::move(*right), *left_from_rig, *right_from_rig};
}

Status write_calibration(const std::filesystem::path& folder,
                         const StereoCalibration& calibration) {
  if (Status s = write_camera(folder, kLeftSensor, calibration.left); !s) {
    return s;
  }
  if (Status s = write_camera(folder, kRightSensor, calibration.right); !s) {
    return s;
  }
  if (Status s = write_extrinsics(extrinsics_of(folder, kLeftSensor),
                                  calibration.left_from_rig.row_major());
      !s) {
    return s;
  }
  return write_extrinsics(extrinsics_of(folder, kRightSensor),
                          calibration.right_from_rig.row_major());
}

Result<DepthCalibration> read_depth_calibration(const std::filesystem::path& folder,
                                                const std::string& sensor, DepthStream stream,
                                                int width_px, int height_px) {
  auto rays = read_rays(lut_of(folder, sensor), {width_px, height_px});
  if (!rays) {
    return rays.error();
  }
  const auto sensor_from_rig = read_extrinsics<DepthSensor>(extrinsics_of(folder, sensor));
  if (!sensor_from_rig) {
    return sensor_from_rig.error();
  }
  return DepthCalibration{stream, width_px, height_px, std::move(*rays), *sensor_from_rig};
}

Status write_depth_calibration(const std::filesystem::path& folder, const std::string& sensor,
                               const DepthCalibration& calibration) {
  std::vector<float> rays;
  rays.reserve(3 * calibration.rays.size());
  for (const DepthCalibration::Ray& ray : calibration.rays) {
    rays.insert(rays.end(), ray.begin(), ray.end());
  }
  if (Status s = write_numbers(lut_of(folder, sensor), rays); !s) {
    return s;
  }
  return write_extrinsics(extrinsics_of(folder, sensor), calibration.sensor_from_rig.row_major());
}

}  // namespace orthonav::replay
