#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/angle.h"
#include "base/result.h"
#include "base/vec.h"

namespace orthonav::engine {

/// The grid of a scan's voxels, metres, LPS. Index 0 runs fastest in memory.
struct VolumeGrid {
  std::array<int, 3> size{};
  Vec3 origin_m;                       ///< centre of the voxel (0, 0, 0)
  Vec3 spacing_m;                      ///< along the three indices
  Mat3 directions = Mat3::identity();  ///< columns: unit directions of the indices

  [[nodiscard]] std::size_t voxels() const {
    return static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]) *
           static_cast<std::size_t>(size[2]);
  }
  [[nodiscard]] std::size_t at(int i, int j, int k) const {
    return (static_cast<std::size_t>(k) * static_cast<std::size_t>(size[1]) +
            static_cast<std::size_t>(j)) *
               static_cast<std::size_t>(size[0]) +
           static_cast<std::size_t>(i);
  }
  /// The place of an index, which may lie between voxels.
  [[nodiscard]] Vec3 place_m(Vec3 index) const {
    return origin_m +
           directions * Vec3{index.x * spacing_m.x, index.y * spacing_m.y, index.z * spacing_m.z};
  }
  [[nodiscard]] Vec3 index_of(Vec3 place_m) const {
    const Vec3 v = directions.transposed() * (place_m - origin_m);
    return {v.x / spacing_m.x, v.y / spacing_m.y, v.z / spacing_m.z};
  }
  /// The voxel around a place; none outside the scan.
  [[nodiscard]] std::optional<std::size_t> voxel_around(Vec3 place_m) const {
    const Vec3 index = index_of(place_m);
    std::array<int, 3> nearest{};
    for (int a = 0; a < 3; ++a) {
      const auto n = static_cast<std::size_t>(a);
      if (!(index[a] > -0.5 && index[a] < size[n] - 0.5)) {
        return std::nullopt;
      }
      nearest[n] = static_cast<int>(index[a] + 0.5);
    }
    return at(nearest[0], nearest[1], nearest[2]);
  }
  [[nodiscard]] double least_spacing_m() const {
    return std::min({spacing_m.x, spacing_m.y, spacing_m.z});
  }
};

/// Refuses fewer than 2 or more than 10,000 voxels along an axis, more than 2^30 in all, spacings
/// outside 0.05-20 mm, axes that are not at right angles or not of unit length, and an origin that
/// is not finite.
[[nodiscard]] Status check_grid(const VolumeGrid& grid);

/// The angle by which a grid's axes may miss right angles, from the rounding of its numbers; as
/// much as a gantry tilt may (`stacked`).
inline constexpr double kMaxShear_rad = 0.2 * kRadiansPerDegree;

/// How far three directions are from right angles at most, rad; pi/2 where one of them is zero.
[[nodiscard]] double shear_rad(const std::array<Vec3, 3>& steps);

/// The grid whose voxels are `steps_m` apart, in LPS, from the first one's centre. Axes that miss
/// right angles by no more than `kMaxShear_rad` are turned evenly to the nearest right ones about
/// the grid's middle, with a note; what misses them by more is refused, and as `check_grid` does.
Result<VolumeGrid> squared_grid(const std::array<int, 3>& size, const std::array<Vec3, 3>& steps_m,
                                Vec3 origin_m, std::vector<std::string>& notes);

/// A scan (HU) or a label map, as stored in its file. Several layers lie one after another, voxel
/// by voxel: value = values[voxel * layers + layer].
struct Volume {
  VolumeGrid grid;
  std::size_t layers = 1;
  std::vector<float> values;                  ///< whole numbers up to 2^24 exactly
  std::map<std::string, std::string> fields;  ///< text in the file (`Segment0_Name`)
  std::vector<std::string> notes;             ///< what was mended or left out, a line each
};

}  // namespace orthonav::engine
