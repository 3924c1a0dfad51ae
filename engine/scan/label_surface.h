#pragma once

#include "base/result.h"
#include "engine/scan/label_part.h"
#include "nav/geometry/mesh.h"

namespace orthonav::engine {

/// How far a mesh lies from the surface of the label that it was made of: from the middle of each
/// face between a voxel inside and one outside to the mesh.
struct SurfaceDeviation {
  double median_m = 0.0;
  double p95_m = 0.0;
  double max_m = 0.0;
};

struct LabelSurface {
  nav::TriangleMesh mesh;  ///< in the scan's frame, metres, LPS
  SurfaceDeviation deviation;
};

/// Free voxels that `label_surface` needs around a part.
inline constexpr int kSurfaceMargin = 4;

/// The smooth surface of a label: closed, manifold, one piece. The signed distance to the border
/// between voxels (Felzenszwalb and Huttenlocher 2012) is smoothed as far as every voxel keeps its
/// side (Whitaker 2000, "Reducing aliasing artifacts in iso-surfaces of binary volumes"), so that
/// stairs go and thin bone stays, by a low pass that does not shrink (after Taubin 1995:
/// 2 S(f) - S(S(f)), S a binomial filter). Between voxels it is interpolated by cubic polynomials
/// (Catmull-Rom), and its zero surface is taken by dual marching cubes
/// (nav/geometry/implicit_surface.h). Refuses what `nav::checked_vertebra` refuses.
Result<LabelSurface> label_surface(const LabelPart& part);

}  // namespace orthonav::engine
