#include "engine/golden/golden_vertebra.h"

#include <cstddef>
#include <optional>
#include <string>

#include "base/check.h"
#include "embedded/golden_vertebra_ply.h"
#include "engine/holograms/shapes/render_values.h"
#include "engine/io/ply_file.h"

namespace orthonav::engine {
namespace {

/// Both entry points of the stage then lie within 0.1 mm of the surface, and the planned axes 4 mm
/// or more inside the pedicles.
constexpr Vec3 kPlaced_m = {-0.00019, -0.00602, 0.00501};
constexpr double kMetresPerUnit = 1e-3;

}  // namespace

nav::TriangleMesh golden_mesh() {
  const Result<PlyFile> file =
      read_ply(std::string(embedded::golden_vertebra_ply()), "data/golden_vertebra.ply");
  ORTHONAV_CHECK(file.ok());
  nav::TriangleMesh mesh;
  for (const Vec3 vertex : file->vertices) {
    mesh.vertices_m.push_back(kMetresPerUnit * vertex + kPlaced_m);
  }
  for (std::size_t i = 0; i + 2 < file->corners.size(); i += 3) {
    mesh.triangles.push_back({file->corners[i], file->corners[i + 1], file->corners[i + 2]});
  }
  return mesh;
}

std::shared_ptr<const render::MeshData> make_golden_vertebra() { return mesh_data(golden_mesh()); }

render::Float3 on_golden_vertebra(float x_m, float z_m) {
  static const nav::SurfaceIndex kSurface(golden_mesh());
  const std::optional<nav::RayHit> hit = kSurface.first_hit({x_m, 1, z_m}, {0, -1, 0});
  ORTHONAV_CHECK(hit);
  return to_float3(hit->point_m);
}

}  // namespace orthonav::engine
