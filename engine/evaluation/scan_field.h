#pragma once

#include <limits>

#include "base/result.h"
#include "base/transform.h"
#include "engine/scan/volume.h"

namespace orthonav::engine {

/// A post-operative scan: axes LPS, origin as its file has it.
struct Scan;

/// Metal is at least this dense; bone and contrast agent are below it.
inline constexpr double kMetal_hu = 2000.0;

/// Refuses what can't be a CT with metal in it: several values a voxel, values that are not finite,
/// no value below -30 (so not in HU: even muscle has noise and fat), no metal, or more of it than
/// 5 % of the scan.
[[nodiscard]] Status check_scan(const Volume& scan);

/// A scan read between its voxels. Borrows the volume.
class ScanField {
 public:
  explicit ScanField(const Volume& scan) : scan_(scan) {}

  [[nodiscard]] const VolumeGrid& grid() const { return scan_.grid; }
  [[nodiscard]] double value(int i, int j, int k) const {
    return static_cast<double>(scan_.values[scan_.grid.at(i, j, k)]);
  }
  /// By trilinear interpolation, HU; not a number outside.
  [[nodiscard]] double at(Vec3 place_m) const;
  [[nodiscard]] bool holds(Vec3 place_m) const;

 private:
  const Volume& scan_;
};

/// Calls `visit(index, place_m)` for each voxel whose middle lies in a box, metres.
template <class Visit>
void for_each_voxel_in(const VolumeGrid& grid, Vec3 low_m, Vec3 high_m, const Visit& visit) {
  std::array<int, 3> first{};
  std::array<int, 3> last{};
  Vec3 low{1e9, 1e9, 1e9};
  Vec3 high{-1e9, -1e9, -1e9};
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 index = grid.index_of({(corner & 1) != 0 ? high_m.x : low_m.x,
                                      (corner & 2) != 0 ? high_m.y : low_m.y,
                                      (corner & 4) != 0 ? high_m.z : low_m.z});
    for (int a = 0; a < 3; ++a) {
      low[a] = std::min(low[a], index[a]);
      high[a] = std::max(high[a], index[a]);
    }
  }
  for (int a = 0; a < 3; ++a) {
    const auto n = static_cast<std::size_t>(a);
    first[n] = std::max(0, static_cast<int>(std::ceil(std::max(low[a], -1.0))));
    last[n] = std::min(grid.size[n] - 1, static_cast<int>(std::floor(std::min(high[a], 1e6))));
  }
  for (int k = first[2]; k <= last[2]; ++k) {
    for (int j = first[1]; j <= last[1]; ++j) {
      for (int i = first[0]; i <= last[0]; ++i) {
        visit(std::array<int, 3>{i, j, k}, grid.place_m({double(i), double(j), double(k)}));
      }
    }
  }
}

}  // namespace orthonav::engine
