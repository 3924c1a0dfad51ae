#include "hal/hl2ss/calibration.h"

#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "hal/hl2ss/protocol.h"

namespace orthonav::hl2ss {
namespace {

constexpr std::size_t kTableBytes = kImageBytes * sizeof(float);

template <class A>
Result<Transform<A, Rig>> read_extrinsics(Bytes bytes) {
  std::array<double, 16> columns_first{};
  for (std::size_t row = 0; row < 4; ++row)
    for (std::size_t column = 0; column < 4; ++column)
      columns_first[4 * column + row] = number_at<float>(bytes, 4 * (4 * row + column));
  for (std::size_t i = 12; i < 16; ++i)
    if (columns_first[i] != (i == 15 ? 1.0 : 0.0))
      return Error{"calibration: last column of the extrinsics must be 0 0 0 1"};
  auto read = Transform<A, Rig>::from_row_major(columns_first);
  if (!read) return Error{"calibration: extrinsics: " + read.error().message};
  return read;
}

template <class A>
Result<CameraCalibration<A>> read_calibration(Bytes answer) {
  if (answer.size() != kCalibrationBytes)
    return Error{"calibration: " + std::to_string(answer.size()) + " bytes, must be " +
                 std::to_string(kCalibrationBytes)};
  std::vector<Vec2> unit_plane(kImageBytes);
  for (std::size_t i = 0; i < kImageBytes; ++i)
    unit_plane[i] = {number_at<float>(answer, 4 * i),
                     number_at<float>(answer, kTableBytes + 4 * i)};
  const auto extrinsics = read_extrinsics<A>(answer.subspan(2 * kTableBytes, kPoseBytes));
  if (!extrinsics) return extrinsics.error();
  auto camera = CameraModel::from_lookup(kImageWidthPx, kImageHeightPx, std::move(unit_plane));
  if (!camera) return Error{"calibration: " + camera.error().message};
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
  for (const Vec2 direction : camera.lookup()) append(bytes, static_cast<float>(direction.x));
  for (const Vec2 direction : camera.lookup()) append(bytes, static_cast<float>(direction.y));
  for (std::size_t column = 0; column < 4; ++column)
    for (std::size_t row = 0; row < 4; ++row)
      append(bytes, static_cast<float>(row_major[4 * row + column]));
  bytes.resize(kCalibrationBytes);
  return bytes;
}

}  // namespace orthonav::hl2ss
