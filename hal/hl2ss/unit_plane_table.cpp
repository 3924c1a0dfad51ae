#include "hal/hl2ss/unit_plane_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace orthonav::hl2ss {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// A line of `count` entries, `stride` apart, resampled half a step on (`ahead` 0.5) or back
/// (-0.5): cubic through the four nearest (Lagrange), which is exact to 1e-9 for a lens, and
/// carried on so past the ends. Between entries without a direction there is none.
void resample_line(const Vec2* from, Vec2* to, std::size_t count, std::size_t stride,
                   double ahead) {
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

/// A headset leaves (0, 0) where its mapping failed, mostly at the edges. The pixel that looks
/// straight ahead may hold the same value, but its neighbours are then close to it.
void forget_unmapped(UnitPlaneTable& table) {
  constexpr double kFarther = 0.05;  // 18 pixels of the front cameras, 9 of AHaT
  const auto is_zero = [](Vec2 v) { return v.x == 0.0 && v.y == 0.0; };
  constexpr std::array<std::array<int, 2>, 4> kBeside = {{{-1, 0}, {1, 0}, {0, -1}, {0, 1}}};
  const std::vector<Vec2> as_told = table.entries;
  for (int row = 0; row < table.height_px; ++row) {
    for (int column = 0; column < table.width_px; ++column) {
      const auto at = static_cast<std::size_t>(row * table.width_px + column);
      if (!is_zero(as_told[at])) {
        continue;
      }
      for (const auto& [across, down] : kBeside) {
        const int x = column + across;
        const int y = row + down;
        if (x < 0 || y < 0 || x >= table.width_px || y >= table.height_px) {
          continue;
        }
        const Vec2 beside = as_told[static_cast<std::size_t>(y * table.width_px + x)];
        if (is_zero(beside) || !(beside.norm() <= kFarther)) {
          table.entries[at] = {kNaN, kNaN};
        }
      }
    }
  }
}

}  // namespace

UnitPlaneTable read_unit_plane(int width_px, int height_px, Bytes x, Bytes y) {
  UnitPlaneTable table{width_px, height_px, {}};
  table.entries.resize(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px));
  for (std::size_t i = 0; i < table.entries.size(); ++i) {
    table.entries[i] = {number_at<float>(x, 4 * i), number_at<float>(y, 4 * i)};
  }
  forget_unmapped(table);
  return table;
}

UnitPlaneTable resampled(const UnitPlaneTable& table, double ahead) {
  std::vector<Vec2> by_rows(table.entries.size());
  UnitPlaneTable both{table.width_px, table.height_px, std::vector<Vec2>(table.entries.size())};
  const auto columns = static_cast<std::size_t>(table.width_px);
  const auto rows = static_cast<std::size_t>(table.height_px);
  for (std::size_t row = 0; row < rows; ++row) {
    resample_line(&table.entries[row * columns], &by_rows[row * columns], columns, 1, ahead);
  }
  for (std::size_t column = 0; column < columns; ++column) {
    resample_line(&by_rows[column], &both.entries[column], rows, columns, ahead);
  }
  return both;
}

}  // namespace orthonav::hl2ss
