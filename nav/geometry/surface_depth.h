#pragma once

#include <optional>

#include "nav/geometry/mesh.h"

namespace orthonav::nav {

/// How deep a place lies below a closed surface.
struct SurfaceDepth {
  double depth_m = 0.0;  ///< distance to the surface; negative outside
  Vec3 deeper;           ///< unit vector along which the depth grows fastest
};

/// Depths of one place after another, below a surface that must live as long. Sooner where
/// neighbours follow one another; the results do not depend on the order. Allocates nothing.
///
/// Whether a place lies inside is decided by the normal of the nearest face where that is beyond
/// doubt, and elsewhere by the rays of `SurfaceIndex::contains`, of which two of three decide: a
/// face that is missing or turned over misleads only who lies next to it. Of an open surface,
/// depths mean nothing; a `VertebraModel`'s is closed, or it would have been refused.
class DepthProbe {
 public:
  explicit DepthProbe(const SurfaceIndex& closed) : closed_(closed) {}
  /// Nothing of a surface without faces and of a place that is not finite.
  [[nodiscard]] std::optional<SurfaceDepth> at(Vec3 place_m);

 private:
  const SurfaceIndex& closed_;
  std::optional<Vec3> last_m_;  ///< on the surface: nothing nearer than it need be looked at
};

}  // namespace orthonav::nav
