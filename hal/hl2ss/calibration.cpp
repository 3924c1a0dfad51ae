#include "hal/hl2ss/calibration.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "hal/hl2ss/protocol.h"

namespace orthonav::hl2ss {
namespace {

constexpr std::size_t kTableBytes = kImageBytes * sizeof(float);
constexpr double kHalfPixel = 0.5;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

using Table = std::vector<Vec2>;

/// A line of `count` entries, `stride` apart, resampled half a step on (`ahead` 0.5) or back
/// (-0.5): cubic through the four nearest (Lagrange), which is exact to 1e-9 for a lens, and
/// carried on so past the ends. Between entries without a direction there is none.
void shift_line(const Vec2* from, Vec2* to, std::size_t count, std::size_t stride, double ahead) {
  for (std::size_t i = 0; i < count; ++i) {
    const double place = static_cast<double>(i) + ahead;
    const double first = std::clamp(std::floor(place) - 1.0, 0.0, static_cast<double>(count - 4));
    const double t = place - first;
    const std::array<double, 4> weights = {-(t - 1) * (t - 2) * (t - 3) / 6,
                                           t * (t - 2) * (t - 3) / 2, -t * (t - 1) * (t - 3) / 2,
                                           t * (t - 1) * (t - 2) / 6};
    Vec2 sum{};
    for (std::size_t k = 0; k < 4; ++k) {
      sum = sum + weights[k] * from[(static_cast<std::size_t>(first) + k) * stride];
    }
    to[i * stride] = sum;
  }
}

/// The table half a pixel to the right and down, or back.
Table shifted(const Table& table, double ahead) {
  Table by_rows(table.size());
  Table both(table.size());
  constexpr std::size_t kColumns = kImageWidthPx;
  for (std::size_t row = 0; row < kImageHeightPx; ++row) {
    shift_line(&table[row * kColumns], &by_rows[row * kColumns], kColumns, 1, ahead);
  }
  for (std::size_t column = 0; column < kColumns; ++column) {
    shift_line(&by_rows[column], &both[column], kImageHeightPx, kColumns, ahead);
  }
  return both;
}

/// A headset leaves (0, 0) where its mapping failed, mostly at the edges. The one pixel that looks
/// straight ahead may say the same, but so do its neighbours nearly.
void forget_unmapped(Table& table) {
  constexpr double kFarther = 0.05;  // 18 pixels of the front cameras
  const auto is_zero = [](Vec2 v) { return v.x == 0.0 && v.y == 0.0; };
  constexpr std::array<std::array<int, 2>, 4> kBeside = {{{-1, 0}, {1, 0}, {0, -1}, {0, 1}}};
  const Table as_told = table;
  for (int row = 0; row < kImageHeightPx; ++row) {
    for (int column = 0; column < kImageWidthPx; ++column) {
      const auto at = static_cast<std::size_t>(row * kImageWidthPx + column);
      if (!is_zero(as_told[at])) {
        continue;
      }
      for (const auto& [across, down] : kBeside) {
        const int x = column + across;
        const int y = row + down;
        if (x < 0 || y < 0 || x >= kImageWidthPx || y >= kImageHeightPx) {
          continue;
        }
        const Vec2 beside = as_told[static_cast<std::size_t>(y * kImageWidthPx + x)];
        if (is_zero(beside) || !(beside.norm() <= kFarther)) {
          table[at] = {kNaN, kNaN};
        }
      }
    }
  }
}

template <class A>
Result<Transform<A, Rig>> read_extrinsics(Bytes bytes) {
  std::array<double, 16> columns_first{};
  for (std::size_t row = 0; row < 4; ++row) {
    for (std::size_t column = 0; column < 4; ++column) {
      columns_first[4 * column + row] = number_at<float>(bytes, 4 * (4 * row + column));
    }
  }
  for (std::size_t i = 12; i < 16; ++i) {
    if (columns_first[i] != (i == 15 ? 1.0 : 0.0)) {
      return Error{"calibration: last column of the extrinsics must be 0 0 0 1"};
    }
  }
  auto read = Transform<A, Rig>::from_row_major(columns_first);
  if (!read) {
    return Error{"calibration: extrinsics: " + read.error().message};
  }
  return read;
}

template <class A>
Result<CameraCalibration<A>> read_calibration(Bytes answer) {
  if (answer.size() != kCalibrationBytes) {
    return Error{"calibration: " + std::to_string(answer.size()) + " bytes, must be " +
                 std::to_string(kCalibrationBytes)};
  }
  Table unit_plane(kImageBytes);
  for (std::size_t i = 0; i < kImageBytes; ++i) {
    unit_plane[i] = {number_at<float>(answer, 4 * i),
                     number_at<float>(answer, kTableBytes + 4 * i)};
  }
  forget_unmapped(unit_plane);
  const auto extrinsics = read_extrinsics<A>(answer.subspan(2 * kTableBytes, kPoseBytes));
  if (!extrinsics) {
    return extrinsics.error();
  }
  auto camera =
      CameraModel::from_lookup(kImageWidthPx, kImageHeightPx, shifted(unit_plane, kHalfPixel));
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
  const Table corners = shifted({camera.lookup().begin(), camera.lookup().end()}, -kHalfPixel);
  // Where there is no direction a headset says (0, 0).
  const auto told = [](Vec2 v, double entry) {
    return std::isnan(v.x) || std::isnan(v.y) ? 0.0f : static_cast<float>(entry);
  };
  for (const Vec2 direction : corners) {
    append(bytes, told(direction, direction.x));
  }
  for (const Vec2 direction : corners) {
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
