#include <cstdint>

#include "render/vulkan/scene_drawing.h"

namespace orthonav::render {

template <class Use>
void SceneDrawing::for_each_surface(const Use& use) {
  std::uint32_t item = 0;
  for (const auto* meshes : {&items_.translucent_meshes(), &items_.solids()}) {
    for (const MeshDraw& draw : *meshes) {
      const GpuMesh* copy = meshes_.find(draw.item->mesh);
      if (copy != nullptr && !copy->levels.empty()) {
        use(copy->levels[draw.level].edges,
            PlacedSurface{item++, meshes == &items_.translucent_meshes(),
                          draw.item->world_from_model});
      }
    }
  }
}

void SceneDrawing::find_edges(const std::vector<View>& views, PixelSize size, DrawnViews drawn) {
  const auto number = [](std::size_t count) { return static_cast<std::uint32_t>(count); };
  for (std::size_t i = drawn.first; i < drawn.first + drawn.count; ++i) {
    const std::uint32_t first = number(edges_.size());
    hidden_edges_.clear();
    for_each_surface([&](const SurfaceEdges& of, const PlacedSurface& surface) {
      of.hide(views[i], size, surface, edge_scratch_, hidden_edges_);
    });
    for_each_surface([&](const SurfaceEdges& of, const PlacedSurface& surface) {
      of.seen_by(views[i], size, surface, hidden_edges_, edge_scratch_, edges_);
    });
    edges_of_view_[i] = {number(items_.data().size()) + first, number(edges_.size()) - first};
  }
}

}  // namespace orthonav::render
