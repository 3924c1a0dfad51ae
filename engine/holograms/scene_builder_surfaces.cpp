// The meshes that a scene shares from frame to frame.

#include <algorithm>

#include "engine/holograms/scene_builder.h"
#include "engine/holograms/shapes/render_values.h"
#include "render/shapes.h"

namespace orthonav::engine {

const std::shared_ptr<const render::MeshData>& SceneBuilder::surface_of(const LevelState& level) {
  auto& surface = surfaces_[level.plan.model.get()];
  if (!surface) {
    surface = mesh_data(level.plan.model->mesh());
  }
  return surface;
}

const std::shared_ptr<const render::MeshData>& SceneBuilder::tinted_surface_of(
    const LevelState& level, std::span<const float> tints) {
  const auto& surface = surface_of(level);
  if (tints.size() != surface->positions.size()) {
    return surface;
  }
  const bool known = tinted_from_ == surface.get() &&
                     std::equal(tints.begin(), tints.end(), tinted_->tints.begin());
  if (!known) {
    auto tinted = std::make_shared<render::MeshData>(*surface);
    tinted->tints.assign(tints.begin(), tints.end());
    tinted_ = std::move(tinted);
    tinted_from_ = surface.get();
  }
  return tinted_;
}

const std::shared_ptr<const render::MeshData>& SceneBuilder::tube_of(std::size_t i,
                                                                     const RodState& rod) {
  Tube& tube = tubes_[i];
  if (tube.points == rod.heads) {
    return tube.mesh;
  }
  tube.points = rod.heads;
  tube.mesh.reset();
  if (rod.rod) {
    std::vector<render::Float3> path;
    for (const Vec3 p : rod.rod->path_m) {
      path.push_back(to_float3(p));
    }
    tube.mesh = std::make_shared<render::MeshData>(
        render::make_tube(path, static_cast<float>(rod.rod->diameter_m / 2.0)));
  }
  return tube.mesh;
}

}  // namespace orthonav::engine
