#pragma once

#include "base/time.h"
#include "engine/session/landmark.h"

namespace orthonav::engine {

/// When the bone was last found where its registration puts it, by check points or by its landmark.
struct BoneFound {
  Timestamp time{};
  /// SD along an axis of its offset then, beyond the registration's own uncertainty.
  double sd_m = 0.0;
  /// SD along an axis by which World drifts in the second after.
  double drift_m_per_sqrt_s = 0.0;

  /// From World's drift since then alone, and including the offset at that time.
  [[nodiscard]] double walked_sd_m(Timestamp now) const;
  [[nodiscard]] double sd_at_m(Timestamp now) const;
};

/// After the landmark was recorded, or found where it was. Recording does not show how far World
/// has drifted by then. Finding it again does: the new SD combines its offset along an axis, the SD
/// of the distance between the two places, and the bone's SD when the landmark was recorded.
[[nodiscard]] BoneFound found_by_landmark(const BoneFound& before, const LandmarkTouch& touch,
                                          const Landmark& landmark, Timestamp now);

}  // namespace orthonav::engine
