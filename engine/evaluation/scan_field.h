#pragma once

#include <cstddef>

#include "base/result.h"
#include "base/transform.h"
#include "engine/scan/volume.h"

namespace orthonav::engine {

/// A post-operative scan: axes LPS, origin as in its file.
struct Scan;

/// Metal is at least this dense; bone and contrast agent are below it.
inline constexpr double kMetal_hu = 2000.0;

/// Refuses a volume that can't be a CT with metal: several values per voxel, values that are not
/// finite, no value below -30 (so not in HU: even muscle has noise and fat), no metal, or more than
/// 5 % of it.
[[nodiscard]] Status check_scan(const Volume& scan);

/// A scan with interpolation between its voxels. Borrows the volume.
class ScanField {
 public:
  explicit ScanField(const Volume& scan) : scan_(scan) {}

  [[nodiscard]] const VolumeGrid& grid() const { return scan_.grid; }
  /// HU of a voxel, by its number in the grid.
  [[nodiscard]] double value(std::size_t voxel) const {
    return static_cast<double>(scan_.values[voxel]);
  }
  /// By trilinear interpolation, HU; not a number outside.
  [[nodiscard]] double at(Vec3 place_m) const;
  [[nodiscard]] bool holds(Vec3 place_m) const;

 private:
  const Volume& scan_;
};

}  // namespace orthonav::engine
