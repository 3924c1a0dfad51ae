#pragma once

#include <optional>

#include "hal/sim/room/room.h"

namespace orthonav::sim {

/// A place on a bone and the outward normal there, in the bone's frame.
struct BoneSpot {
  Vec3 point;
  Vec3 normal;  ///< unit
};

/// Answers queries by testing every triangle, which is fast enough for a few per minute. The level
/// must outlive it.
class BoneSurface {
 public:
  explicit BoneSurface(const RoomLevel& level) : level_(&level) {}
  /// The nearest place of the surface.
  [[nodiscard]] BoneSpot closest(Vec3 point) const;
  /// Where a ray first meets the surface from outside, within `reach_m` along the unit vector
  /// `direction`.
  [[nodiscard]] std::optional<BoneSpot> first_hit(Vec3 origin, Vec3 direction,
                                                  double reach_m) const;

 private:
  const RoomLevel* level_;
};

}  // namespace orthonav::sim
