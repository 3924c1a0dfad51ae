#include "engine/holograms/anchored_frame.h"

#include "engine/holograms/shapes/render_values.h"

namespace orthonav::engine {
namespace {

render::Float3 taken(const Transform<World, World>& by, render::Float3 p) {
  return to_float3((by * Point<World>{{p.x, p.y, p.z}}).v);
}

/// The matrix of a model that is already placed in the scene.
render::Matrix4 taken(const Transform<World, World>& by, const render::Matrix4& model) {
  render::Matrix4 out = model;
  for (int column = 0; column < 4; ++column) {
    const render::Float4 v = model[column];
    const Vec3 w =
        by.rotation() * Vec3{v.x, v.y, v.z} + static_cast<double>(v.w) * by.translation();
    out[column] = render::Float4(to_float3(w), v.w);
  }
  return out;
}

}  // namespace

void take_to_map(const Transform<World, World>& by, render::Scene& scene) {
  for (render::MeshItem& mesh : scene.meshes) {
    mesh.world_from_model = taken(by, mesh.world_from_model);
  }
  for (render::LineItem& line : scene.lines) {
    for (render::Float3& point : line.points) {
      point = taken(by, point);
    }
  }
  for (render::TriangleItem& triangle : scene.triangles) {
    for (render::Float3& corner : triangle.corners) {
      corner = taken(by, corner);
    }
  }
  for (render::TextItem& text : scene.texts) {
    if (text.place == render::TextPlace::kWorld) {
      text.position = taken(by, text.position);
    }
  }
}

void take_to_map(const Transform<World, World>& by, ShownFrame& frame) {
  for (ShownHologram& hologram : frame.holograms) {
    for (Point<World>& point : hologram.points_in_world) {
      point = by * point;
    }
  }
}

void take_to_map(const Transform<World, World>& by, std::vector<GlarePatch>& patches) {
  for (GlarePatch& patch : patches) {
    for (render::Float3& corner : patch) {
      corner = taken(by, corner);
    }
  }
}

}  // namespace orthonav::engine
