#pragma once

#include "base/result.h"
#include "engine/scan/label_part.h"
#include "nav/geometry/mesh.h"

namespace orthonav::engine {

/// The distance of a mesh from the label's surface: from the middle of each face between a voxel
/// inside and one outside to the mesh.
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
/// between voxels (Felzenszwalb and Huttenlocher 2012) is smoothed while every voxel keeps its side
/// (Whitaker 2000, "Reducing aliasing artifacts in iso-surfaces of binary volumes"), so that steps
/// vanish and thin bone stays, by a low pass that does not shrink (after Taubin 1995: 2 S(f) -
/// S(S(f)), S a binomial filter). Between voxels it is interpolated by cubic polynomials
/// (Catmull-Rom), and its zero surface is taken by dual marching cubes
/// (nav/geometry/implicit_surface.h). Refuses a mesh that `nav::checked_bone` refuses.
Result<LabelSurface> label_surface(const LabelPart& part);

}  // namespace orthonav::engine
