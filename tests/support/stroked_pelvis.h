#pragma once

#include <optional>
#include <vector>

#include "base/transform.h"
#include "nav/geometry/mesh.h"

namespace orthonav::test {

/// A sawbone pelvis that others stroked with an NDI pointer (UCL MPHY0026; shared/real).
struct StrokedPelvis {
  nav::TriangleMesh mesh;  ///< of its CT, where the scan cuts it closed by fans
  std::vector<Point<World>> strokes;
  std::vector<Vec3> posts_in_model_m;  ///< four, also touched
  std::vector<Vec3> posts_in_world_m;
};

/// Nothing where shared/real is absent.
[[nodiscard]] std::optional<StrokedPelvis> stroked_pelvis();

}  // namespace orthonav::test
