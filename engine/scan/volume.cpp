#include "engine/scan/volume.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "base/printed.h"

namespace orthonav::engine {

Status check_grid(const VolumeGrid& grid) {
  constexpr double kLeastSpacing_m = 0.00005;
  constexpr double kMaxSpacing_m = 0.020;
  constexpr double kSquare = 1e-3;
  constexpr int kLeastSide = 2;
  constexpr int kMostSide = 10000;
  for (const int side : grid.size) {
    if (side < kLeastSide || side > kMostSide) {
      return Error{"has " + std::to_string(side) + " voxels along an axis, must have " +
                   std::to_string(kLeastSide) + " to " + std::to_string(kMostSide)};
    }
  }
  constexpr std::size_t kMaxVoxels = std::size_t{1} << 30;
  if (grid.voxels() > kMaxVoxels) {
    return Error{"has more than " + std::to_string(kMaxVoxels) + " voxels"};
  }
  for (int d = 0; d < 3; ++d) {
    const double spacing_m = grid.spacing_m[d];
    if (!(spacing_m >= kLeastSpacing_m && spacing_m <= kMaxSpacing_m)) {
      return Error{printed("voxels of %.3f mm, must be %.2f to %.0f mm", spacing_m * 1e3,
                           kLeastSpacing_m * 1e3, kMaxSpacing_m * 1e3)};
    }
  }
  if (!(orthonormality_error(grid.directions.transposed()) < kSquare)) {
    return Error{"its axes are not at right angles"};
  }
  return grid.origin_m.is_finite() ? Status{} : Status{Error{"its origin is not finite"}};
}

double shear_rad(const std::array<Vec3, 3>& steps) {
  double most = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 a = steps[i], b = steps[(i + 1) % 3];
    const double lengths = a.norm() * b.norm();
    if (!(lengths > 0.0)) {
      return std::numbers::pi / 2;
    }
    most = std::max(most, std::asin(std::min(std::abs(a.dot(b)) / lengths, 1.0)));
  }
  return most;
}

Result<VolumeGrid> squared_grid(const std::array<int, 3>& size, const std::array<Vec3, 3>& steps_m,
                                Vec3 origin_m, std::vector<std::string>& notes) {
  constexpr double kSaid_rad = 1e-3 * kRadiansPerDegree;
  VolumeGrid grid;
  grid.size = size;
  grid.origin_m = origin_m;
  std::array<Vec3, 3> axes;
  for (std::size_t i = 0; i < 3; ++i) {
    const double length_m = steps_m[i].norm();
    grid.spacing_m[static_cast<int>(i)] = length_m;
    axes[i] = length_m > 0.0 ? steps_m[i] / length_m : Vec3{};
  }
  if (const Status sized = check_grid(grid); !sized) {
    return sized.error();
  }
  const double shear = shear_rad(steps_m);
  if (!(shear <= kMaxShear_rad)) {
    return Error{beside_limit(
        "its axes are %.2f° off right angles, limit %.2f°: a tilted gantry, or a sheared export; "
        "resample it to right angles",
        shear * kDegreesPerRadian, kMaxShear_rad * kDegreesPerRadian)};
  }
  // Löwdin's symmetric orthogonalization: it favours none of the axes.
  for (int round = 0; round < 4; ++round) {
    const std::array<Vec3, 3> before = axes;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 a = before[i], b = before[(i + 1) % 3], c = before[(i + 2) % 3];
      axes[i] = (a - 0.5 * a.dot(b) * b - 0.5 * a.dot(c) * c).normalized();
    }
  }
  grid.directions = Mat3::from_columns(axes[0], axes[1], axes[2]);
  const Vec3 half{0.5 * (size[0] - 1), 0.5 * (size[1] - 1), 0.5 * (size[2] - 1)};
  const Vec3 middle_m = origin_m + half.x * steps_m[0] + half.y * steps_m[1] + half.z * steps_m[2];
  grid.origin_m = {};  // the middle stays, not the first voxel
  grid.origin_m = middle_m - grid.place_m(half);
  if (shear > kSaid_rad) {
    notes.push_back(printed("its axes are %.3f° off right angles, read as at right angles",
                            shear * kDegreesPerRadian));
  }
  return grid;
}

}  // namespace orthonav::engine
