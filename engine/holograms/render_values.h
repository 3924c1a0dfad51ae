#pragma once

#include <array>
#include <memory>

#include "base/vec.h"
#include "nav/geometry/mesh.h"
#include "render/scene.h"

namespace orthonav::engine {

// What nav and hal hold in double, as the renderer takes it.

[[nodiscard]] render::Float3 to_float3(Vec3 v);
[[nodiscard]] render::Matrix4 to_matrix(const std::array<double, 16>& row_major);
/// With smooth normals.
[[nodiscard]] std::shared_ptr<const render::MeshData> mesh_data(const nav::TriangleMesh& mesh);

}  // namespace orthonav::engine
