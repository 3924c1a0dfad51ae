#pragma once

#include <optional>

#include "nav/geometry/mesh.h"

namespace orthonav::nav {

/// How deep a place lies below a closed surface.
struct SurfaceDepth {
  double depth_m = 0.0;  ///< distance to the surface; negative outside
  Vec3 deeper;           ///< unit vector along which the depth grows fastest
};

/// Depths of one place after another below a surface, which must outlive the probe. Faster if
/// successive places are close together; the results do not depend on the order. Allocates nothing.
///
/// Whether a place lies inside is decided by the normal of the nearest face if that is unambiguous,
/// and otherwise by a majority of the three rays of `SurfaceIndex::contains`: a face that is
/// missing or inverted misleads only places next to it. For an open surface, depths are
/// meaningless; the surface of a `VertebraModel` is closed, since an open one is refused.
class DepthProbe {
 public:
  explicit DepthProbe(const SurfaceIndex& closed) : closed_(closed) {}
  /// Empty for a surface without faces, for a place that is not finite, and for one farther than
  /// `within_m` from the surface: to find out that much is faster.
  [[nodiscard]] std::optional<SurfaceDepth> at(Vec3 place_m, double within_m = 1e9);

 private:
  const SurfaceIndex& closed_;
  std::optional<Vec3> last_m_;  ///< on the surface: the search need not reach beyond it
};

}  // namespace orthonav::nav
