#pragma once

#include <array>
#include <memory>

#include "base/transform.h"
#include "base/vec.h"
#include "nav/geometry/mesh.h"
#include "render/scene.h"

namespace orthonav::engine {

// Converts double values of nav and hal to the renderer's types and back.

[[nodiscard]] render::Float3 to_float3(Vec3 v);
[[nodiscard]] Vec3 to_vec3(render::Float3 v);
[[nodiscard]] render::Matrix4 to_matrix(const std::array<double, 16>& row_major);
/// The view of an eye in a HoloLens 2.
[[nodiscard]] render::View hololens2_view(const Transform<World, Eye>& world_from_eye);
/// With smooth normals, and prepared for drawing.
[[nodiscard]] std::shared_ptr<const render::MeshData> mesh_data(const nav::TriangleMesh& mesh);

}  // namespace orthonav::engine
