#pragma once

#include "base/time.h"
#include "engine/session/landmark.h"

namespace orthonav::engine {

/// When the bone was last found where its registration has it: by check points, or by its landmark.
struct BoneFound {
  Timestamp time{};
  /// SD along an axis by which it may have been off then, beyond what the registration's own
  /// uncertainty says.
  double sd_m = 0.0;
  /// SD along an axis by which World walks in the second after.
  double drift_m_per_sqrt_s = 0.0;

  /// By World's walk since alone, and with what it may have been off then.
  [[nodiscard]] double walked_sd_m(Timestamp now) const;
  [[nodiscard]] double sd_at_m(Timestamp now) const;
};

/// After the landmark was recorded, or found where it was. Recording tells nothing of how far World
/// has walked by then. Finding it again does: what it is off by has that as its mean square along
/// an axis, and the SDs of the two places beside it; what World walked before the recording stays.
[[nodiscard]] BoneFound found_by_landmark(const BoneFound& before, const LandmarkTouch& touch,
                                          const Landmark& landmark, Timestamp now);

}  // namespace orthonav::engine
