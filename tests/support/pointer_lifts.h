#pragma once

#include <vector>

#include "base/random.h"
#include "nav/geometry/mesh.h"
#include "tests/support/stroke_walk.h"

namespace orthonav::test {

/// A place of the tip in time.
struct TipPlace {
  Touch touch;
  BoneRegion region = BoneRegion::kCrest;
  int stroke = 0;
  bool off_bone = false;
};

struct LiftOptions {
  double fraction = 0.12;  ///< of the places that leave the bone
  double least_m = 0.001;
  double largest_m = 0.010;
  double tip_radius_m = 0.0;
};

/// Moves exactly a share of the places off the bone: most in bursts, as when the pointer comes down
/// late, is lifted early or hops in between; the others one by one, outwards or into the soft
/// tissue beside. Every moved place is outside the bone, at a distance between the two limits.
void lift_some(const nav::SurfaceIndex& surface, const LiftOptions& options, Random& random,
               std::vector<TipPlace>& places);

}  // namespace orthonav::test
