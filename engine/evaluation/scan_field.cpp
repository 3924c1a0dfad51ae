#include "engine/evaluation/scan_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "base/printed.h"

namespace orthonav::engine {
namespace {

/// Whether an index lies between voxels of the grid.
bool is_inside(const VolumeGrid& grid, Vec3 index) {
  constexpr double kRounding = 1e-6;  // of a voxel, at the border
  for (int a = 0; a < 3; ++a) {
    const int last = grid.size[static_cast<std::size_t>(a)] - 1;
    if (!(index[a] >= -kRounding && index[a] <= last + kRounding)) {
      return false;
    }
  }
  return true;
}

}  // namespace

Status check_scan(const Volume& scan) {
  constexpr double kNotHu = -30.0;
  constexpr double kMaxMetal = 0.05;
  if (scan.layers != 1) {
    return Error{"the scan has " + std::to_string(scan.layers) + " values a voxel, a CT has one"};
  }
  std::size_t metal = 0;
  float least = std::numeric_limits<float>::max();
  float most = std::numeric_limits<float>::lowest();
  for (const float hu : scan.values) {
    if (!std::isfinite(hu)) {
      return Error{"the scan holds a value that is not a number"};
    }
    least = std::min(least, hu);
    most = std::max(most, hu);
    metal += static_cast<double>(hu) >= kMetal_hu ? 1 : 0;
  }
  if (scan.values.empty() || static_cast<double>(least) > kNotHu) {
    return Error{printed("the scan is not a CT in HU: its least value is %.0f, limit %.0f",
                         static_cast<double>(least), kNotHu)};
  }
  if (metal == 0) {
    return Error{printed("no metal in the scan: its largest value is %.0f HU, limit %.0f",
                         static_cast<double>(most), kMetal_hu)};
  }
  const double fraction = static_cast<double>(metal) / static_cast<double>(scan.values.size());
  if (fraction > kMaxMetal) {
    return Error{printed("%.0f %% of the scan has %.0f HU or more, limit %.0f %%: no CT of a spine",
                         fraction * 1e2, kMetal_hu, kMaxMetal * 1e2)};
  }
  return {};
}

bool ScanField::holds(Vec3 place_m) const { return is_inside(grid(), grid().index_of(place_m)); }

double ScanField::at(Vec3 place_m) const {
  const Vec3 index = grid().index_of(place_m);
  if (!is_inside(grid(), index)) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  std::array<int, 3> low{};
  Vec3 part;
  for (int a = 0; a < 3; ++a) {
    const int last = grid().size[static_cast<std::size_t>(a)] - 1;
    const int whole = std::clamp(static_cast<int>(index[a]), 0, std::max(0, last - 1));
    low[static_cast<std::size_t>(a)] = whole;
    part[a] = std::clamp(index[a] - whole, 0.0, 1.0);
  }
  double sum = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    double weight = 1.0;
    std::array<int, 3> at = low;
    for (int a = 0; a < 3; ++a) {
      const bool up = ((corner >> a) & 1) != 0;
      weight *= up ? part[a] : 1.0 - part[a];
      at[static_cast<std::size_t>(a)] += up ? 1 : 0;
    }
    if (weight > 0.0) {
      sum += weight * value(grid().at(at[0], at[1], at[2]));
    }
  }
  return sum;
}

}  // namespace orthonav::engine
