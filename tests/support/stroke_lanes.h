#pragma once

#include <vector>

#include "base/random.h"
#include "base/vec.h"
#include "tests/support/posterior_landmarks.h"

namespace orthonav::test {

/// The part of the bone that a stroke covers.
enum class BoneRegion {
  kLeftLamina,
  kRightLamina,
  kLeftFacet,
  kRightFacet,
  kLeftTransverseRoot,
  kRightTransverseRoot,
  kLeftSpinousSide,
  kRightSpinousSide,
  kCrest,
};
inline constexpr int kBoneRegions = 9;
/// "left lamina" and so on.
[[nodiscard]] const char* name_of(BoneRegion region);
/// +1 for the patient's left, -1 for the right, 0 for the crest.
[[nodiscard]] int side_of(BoneRegion region);

/// A movement of the hand: the points at which the pointer is aimed, and the direction of its
/// handle. The path sways sideways, and the handle tilts on the way.
struct Lane {
  BoneRegion region = BoneRegion::kCrest;
  Vec3 from_m;
  Vec3 to_m;
  double left_rad = 0.0;  ///< of the handle, from straight behind towards the patient's left
  double up_rad = 0.0;
  double sway_m = 0.0;
  double wave_m = 0.02;
  double phase_rad = 0.0;

  /// Unit, from the bone towards the handle.
  [[nodiscard]] Vec3 approach(double more_left_rad = 0.0, double more_up_rad = 0.0) const;
};

/// Movements over a region about `pitch_m` apart, to and fro. They reach beyond the bone: a walk
/// along them (stroke_walk.h) ends where the bone does.
[[nodiscard]] std::vector<Lane> lanes_over(BoneRegion region, const PosteriorLandmarks& landmarks,
                                           double pitch_m, Random& random);

}  // namespace orthonav::test
