#include "engine/holograms/shapes/hologram_twin.h"

#include "engine/holograms/shapes/hologram_parts.h"
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
    const Float3 moved = in_twin(twin, Float3(m[3]));
    m = {kTwinScale * m[0], kTwinScale * m[1], kTwinScale * m[2], render::Float4(moved, 1)};
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
