#include "engine/holograms/hologram_twin.h"

#include "engine/holograms/hologram_parts.h"
#include "render/float3.h"

namespace orthonav::engine {

using render::Float3;

Float3 in_twin(const VirtualTwin& twin, Float3 place) {
  return twin.site + kTwinBeside_m * twin.beside + kTwinScale * (place - twin.site);
}

void add_tool(render::Scene& scene, Float3 tip, Float3 axis, render::Label label) {
  constexpr float kWidth_m = 0.002f;
  constexpr float kLength_m = 0.080f;
  add_line(scene, {tip, tip + kLength_m * render::unit_or(axis, {0, 1, 0})}, kWidth_m, look::kWhite,
           label);
}

void add_twin(render::Scene& scene, const VirtualTwin& twin, const render::Scene& parts,
              render::Label label) {
  for (const render::MeshItem& part : parts.meshes) {
    render::MeshItem& item = scene.meshes.emplace_back();
    item = part;
    render::Matrix4& m = item.world_from_model;
    const Float3 moved = in_twin(twin, {m[12], m[13], m[14]});
    for (const std::size_t i : {0U, 1U, 2U, 4U, 5U, 6U, 8U, 9U, 10U}) {
      m[i] *= kTwinScale;
    }
    m[12] = moved.x;
    m[13] = moved.y;
    m[14] = moved.z;
    item.label = label;
  }
  for (const render::LineItem& part : parts.lines) {
    render::LineItem& item = scene.lines.emplace_back();
    item = part;
    for (Float3& point : item.points) {
      point = in_twin(twin, point);
    }
    item.width_m *= kTwinScale;
    item.dash_m *= kTwinScale;
    item.label = label;
  }
  for (render::TriangleItem item : parts.triangles) {
    for (Float3& corner : item.corners) {
      corner = in_twin(twin, corner);
    }
    item.label = label;
    scene.triangles.push_back(item);
  }
}

}  // namespace orthonav::engine
