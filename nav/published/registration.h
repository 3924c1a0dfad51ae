#pragma once

#include <array>
#include <span>

#include "base/result.h"
#include "base/transform.h"
#include "nav/geometry/mesh.h"
#include "nav/published/icp.h"

namespace orthonav::nav::published {

/// The registration of Liebmann et al. 2019, section 3.2, and nothing beside it: no point is left
/// out, nothing is tried twice, nothing is refused. Whether the bone lies where it is shown the
/// surgeon judges by eye.

/// Equation 1: the points farthest out along the first two principal axes pa1 and pa2 of a cloud,
/// with each p relative to the cloud's centroid (the paper leaves its origin open).
struct ExtremePoints {
  Vec3 e1;  ///< argmax pa1·p
  Vec3 e2;  ///< argmin pa1·p
  Vec3 e3;  ///< argmax |pa2·p|
};
/// Needs one point or more. The axes are those of the points, each of which counts alike.
[[nodiscard]] ExtremePoints extreme_points(std::span<const Vec3> points_m);

/// Equation 2: an axis has no sign, so e1 of the digitized points belongs to e1 or to e2 of the
/// model; e3 belongs to e3. Each of the two configurations of three pairs gives a coarse pose by
/// absolute orientation (Horn 1987).
[[nodiscard]] Result<std::array<Transform<World, Vertebra>, 2>> coarse_poses(
    const ExtremePoints& of_model, const ExtremePoints& digitized);

/// ICP from both coarse poses on the trimmed model, the better one (the smaller RMSE) first; the
/// paper shows that one. `trimmed` is the model without the points "which can definitely not be
/// reached" (nav/registration/vertebra_model.h), in frame Vertebra; its vertices are the cloud
/// whose extreme points count. An Error if three of either side's extreme points lie on a line.
Result<std::array<IcpResult, 2>> register_points(const TriangleMesh& trimmed,
                                                 const SurfaceIndex& surface,
                                                 std::span<const Point<World>> digitized);

}  // namespace orthonav::nav::published
