#include "engine/scan/volume.h"

#include <string>

#include "base/printed.h"

namespace orthonav::engine {

Status check_grid(const VolumeGrid& grid) {
  constexpr double kLeastSpacing_m = 0.00005;
  constexpr double kMostSpacing_m = 0.020;
  constexpr double kSquare = 1e-3;
  constexpr int kLeastSide = 2;
  constexpr int kMostSide = 10000;
  for (const int side : grid.size) {
    if (side < kLeastSide || side > kMostSide) {
      return Error{"has " + std::to_string(side) + " voxels along an axis, must have " +
                   std::to_string(kLeastSide) + " to " + std::to_string(kMostSide)};
    }
  }
  constexpr std::size_t kMostVoxels = std::size_t{1} << 30;
  if (grid.voxels() > kMostVoxels) {
    return Error{"has more than " + std::to_string(kMostVoxels) + " voxels"};
  }
  for (int d = 0; d < 3; ++d) {
    const double spacing_m = grid.spacing_m[d];
    if (!(spacing_m >= kLeastSpacing_m && spacing_m <= kMostSpacing_m)) {
      return Error{printed("voxels of %.3f mm, must be %.2f to %.0f mm", spacing_m * 1e3,
                           kLeastSpacing_m * 1e3, kMostSpacing_m * 1e3)};
    }
  }
  if (!(orthonormality_error(grid.directions.transposed()) < kSquare)) {
    return Error{"its axes are not at right angles"};
  }
  return grid.origin_m.is_finite() ? Status{} : Status{Error{"its origin is not finite"}};
}

}  // namespace orthonav::engine
