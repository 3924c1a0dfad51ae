#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "hal/sim/room/bone_surface.h"

namespace orthonav::sim {

/// The visible surface of a bone from one side: the nearest surface for each cell of a grid across
/// the line of sight. Coordinates: `u` across, `v` along z (superior), `height` towards the eye.
class SurfaceMap {
 public:
  /// Seen from `from`, a unit vector in the x-y plane of the vertebra.
  SurfaceMap(const RoomLevel& level, Vec3 from);

  /// The surface under a place of the grid; nothing off the bone and across steps in depth.
  [[nodiscard]] std::optional<BoneSpot> at(Vec2 uv_m) const;
  [[nodiscard]] Vec2 uv(Vec3 point) const { return {u_axis_.dot(point), point.z}; }
  [[nodiscard]] Vec2 low() const { return low_; }
  [[nodiscard]] Vec2 high() const { return high_; }
  [[nodiscard]] Vec3 from() const { return from_; }
  static constexpr double kStep_m = 0.0005;

 private:
  struct Cell {
    double height = -std::numeric_limits<double>::infinity();
    Vec3 normal;
  };
  void draw(const RoomLevel& level, const std::array<std::uint32_t, 3>& triangle);
  [[nodiscard]] const Cell* cell(int column, int row) const;

  Vec3 from_;
  Vec3 u_axis_;
  Vec2 low_;
  Vec2 high_;
  int columns_ = 0;
  int rows_ = 0;
  std::vector<Cell> cells_;
};

}  // namespace orthonav::sim
