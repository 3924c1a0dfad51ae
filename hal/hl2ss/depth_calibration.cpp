#include "hal/hl2ss/depth_calibration.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/printed.h"
#include "hal/hl2ss/depth_format.h"
#include "hal/hl2ss/extrinsics.h"
#include "hal/hl2ss/unit_plane_table.h"

namespace orthonav::hl2ss {
namespace {

/// Steps from 10 mm down to 0.01 mm; a headset's are 1 mm.
constexpr double kLeastUnits = 1e2;
constexpr double kMaxUnits = 1e5;
/// From this value on, AHaT means that nothing was measured.
constexpr std::size_t kAhatNothing = 4090;

Status check_scale(double units_per_m) {
  if (!(units_per_m >= kLeastUnits && units_per_m <= kMaxUnits)) {
    return Error{"calibration: scale " + printed("%g", units_per_m) +
                 ", must lie in [100, 100000]"};
  }
  return {};
}

/// Ranges do not depend on it, so any positive number is accepted.
Status check_alias(double alias) {
  if (!(alias > 0.0 && std::isfinite(alias))) {
    return Error{"calibration: alias " + printed("%g", alias) + ", must be positive"};
  }
  return {};
}

}  // namespace

std::size_t depth_calibration_bytes(DepthStream stream) {
  const DepthFormat format = format_of(stream);
  const std::size_t numbers = 1 + (format.wraps ? 1 : 0) + 4;
  return sizeof(float) * (4 * format.pixels() + numbers) + kPoseBytes;
}

Result<DepthDescription> read_depth_calibration(DepthStream stream, Bytes answer) {
  const DepthFormat format = format_of(stream);
  const std::size_t expected = depth_calibration_bytes(stream);
  if (answer.size() != expected) {
    return Error{"calibration: " + std::to_string(answer.size()) + " bytes, must be " +
                 std::to_string(expected)};
  }
  const std::size_t table_bytes = sizeof(float) * format.pixels();
  ByteReader rest(answer.subspan(2 * table_bytes));
  const auto sensor_from_rig = read_extrinsics<DepthSensor>(rest.take_bytes(kPoseBytes));
  if (!sensor_from_rig) {
    return sensor_from_rig.error();
  }
  DepthDescription described;
  described.units_per_m = static_cast<double>(rest.take<float>());
  if (const Status s = check_scale(described.units_per_m); !s) {
    return s.error();
  }
  const double alias = format.wraps ? static_cast<double>(rest.take<float>()) : 0.0;
  if (const Status s = format.wraps ? check_alias(alias) : Status(); !s) {
    return s.error();
  }
  const UnitPlaneTable centres = resampled(
      read_unit_plane(format.width_px, format.height_px, answer, answer.subspan(table_bytes)),
      kHalfPixel);
  DepthCalibration& camera = described.camera;
  camera = {stream, format.width_px,  format.height_px,
            {},     *sensor_from_rig, alias / described.units_per_m};
  std::transform(centres.entries.begin(), centres.entries.end(), std::back_inserter(camera.rays),
                 DepthCalibration::ray_through);
  if (std::all_of(camera.rays.begin(), camera.rays.end(),
                  [](const DepthCalibration::Ray& ray) { return ray[2] == 0.0F; })) {
    return Error{"calibration: no pixel has a direction"};
  }
  return described;
}

std::vector<std::uint16_t> millimetres_of(const DepthDescription& camera) {
  constexpr std::size_t kNumbers = 65536;
  std::vector<std::uint16_t> millimetres(kNumbers, 0);
  const std::size_t end = camera.camera.stream == DepthStream::kAhat ? kAhatNothing : kNumbers;
  for (std::size_t raw = 1; raw < end; ++raw) {
    const double mm = std::floor(1e3 * static_cast<double>(raw) / camera.units_per_m + 0.5);
    millimetres[raw] = mm < kNumbers ? static_cast<std::uint16_t>(mm) : std::uint16_t{0};
  }
  return millimetres;
}

}  // namespace orthonav::hl2ss
