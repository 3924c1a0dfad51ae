#include "engine/holograms/shapes/render_values.h"

#include <glm/gtc/type_ptr.hpp>
#include <utility>

#include "render/decimated.h"
#include "render/shapes.h"

namespace orthonav::engine {
namespace {

// Half of a HoloLens 2's field of view, as tangents.
constexpr float kTanAcross = 0.394f;
constexpr float kTanDown = 0.2561f;

}  // namespace

render::Float3 to_float3(Vec3 v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

Vec3 to_vec3(render::Float3 v) { return {v.x, v.y, v.z}; }

render::Matrix4 to_matrix(const std::array<double, 16>& row_major) {
  return glm::transpose(glm::mat4(glm::make_mat4(row_major.data())));
}

render::View hololens2_view(const Transform<World, Eye>& world_from_eye) {
  render::View view;
  view.eye_from_world = to_matrix(world_from_eye.inverse().row_major());
  view.tan_left = view.tan_right = kTanAcross;
  view.tan_up = view.tan_down = kTanDown;
  return view;
}

std::shared_ptr<const render::MeshData> mesh_data(const nav::TriangleMesh& mesh) {
  render::MeshData data;
  for (const Vec3 v : mesh.vertices_m) {
    data.positions.push_back(to_float3(v));
  }
  for (const auto& triangle : mesh.triangles) {
    data.indices.insert(data.indices.end(), triangle.begin(), triangle.end());
  }
  data.normals = render::smooth_normals(data.positions, data.indices);
  return render::prepared(std::move(data));
}

}  // namespace orthonav::engine
