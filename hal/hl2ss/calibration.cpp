#include "hal/hl2ss/calibration.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "hal/hl2ss/extrinsics.h"
#include "hal/hl2ss/protocol.h"
#include "hal/hl2ss/unit_plane_table.h"

namespace orthonav::hl2ss {
namespace {

constexpr std::size_t kTableBytes = kImageBytes * sizeof(float);

template <class A>
Result<CameraCalibration<A>> read_calibration(Bytes answer) {
  if (answer.size() != kCalibrationBytes) {
    return Error{"calibration: " + std::to_string(answer.size()) + " bytes, must be " +
                 std::to_string(kCalibrationBytes)};
  }
  const UnitPlaneTable unit_plane = read_unit_plane(
      kImageWidthPx, kImageHeightPx, answer.first(kTableBytes), answer.subspan(kTableBytes));
  const auto extrinsics = read_extrinsics<A>(answer.subspan(2 * kTableBytes, kPoseBytes));
  if (!extrinsics) {
    return extrinsics.error();
  }
  auto camera = CameraModel::from_lookup(kImageWidthPx, kImageHeightPx,
                                         resampled(unit_plane, kHalfPixel).entries);
  if (!camera) {
    return Error{"calibration: " + camera.error().message};
  }
  return CameraCalibration<A>{std::move(*camera), *extrinsics};
}

}  // namespace

Result<CameraCalibration<LeftCamera>> read_left_calibration(Bytes answer) {
  return read_calibration<LeftCamera>(answer);
}

Result<CameraCalibration<RightCamera>> read_right_calibration(Bytes answer) {
  return read_calibration<RightCamera>(answer);
}

std::vector<std::uint8_t> calibration_bytes(const CameraModel& camera,
                                            const std::array<double, 16>& row_major) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(kCalibrationBytes);
  const UnitPlaneTable centres{
      camera.width_px(), camera.height_px(), {camera.lookup().begin(), camera.lookup().end()}};
  const UnitPlaneTable corners = resampled(centres, -kHalfPixel);
  // Where there is no direction a headset says (0, 0).
  const auto told = [](Vec2 v, double entry) {
    return std::isnan(v.x) || std::isnan(v.y) ? 0.0f : static_cast<float>(entry);
  };
  for (const Vec2 direction : corners.entries) {
    append(bytes, told(direction, direction.x));
  }
  for (const Vec2 direction : corners.entries) {
    append(bytes, told(direction, direction.y));
  }
  for (std::size_t column = 0; column < 4; ++column) {
    for (std::size_t row = 0; row < 4; ++row) {
      append(bytes, static_cast<float>(row_major[4 * row + column]));
    }
  }
  bytes.resize(kCalibrationBytes);
  return bytes;
}

void unmap_edges(std::vector<std::uint8_t>& answer, int edge_px) {
  for (int row = 0; row < kImageHeightPx; ++row) {
    for (int column = 0; column < kImageWidthPx; ++column) {
      const bool inside = row >= edge_px && row < kImageHeightPx - edge_px && column >= edge_px &&
                          column < kImageWidthPx - edge_px;
      const std::size_t at = sizeof(float) * static_cast<std::size_t>(row * kImageWidthPx + column);
      for (const std::size_t table : {std::size_t{0}, kTableBytes}) {
        if (!inside) {
          std::fill_n(answer.begin() + static_cast<std::ptrdiff_t>(table + at), sizeof(float),
                      std::uint8_t{0});
        }
      }
    }
  }
}

}  // namespace orthonav::hl2ss
