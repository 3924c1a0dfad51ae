#include "engine/holograms/scene_builder.h"
#include "engine/holograms/shapes/hologram_label.h"
#include "engine/holograms/shapes/render_values.h"
#include "engine/holograms/shapes/screw_holograms.h"

namespace orthonav::engine {

void SceneBuilder::add_bone(const PlacedLevel& at, std::span<const float> unstroked,
                            render::Scene& scene) {
  add_vertebra(scene, tinted_surface_of(*at.level, unstroked),
               to_matrix(at.world_from_vertebra.row_major()), label_of(HologramKind::kVertebra, 1));
}

void SceneBuilder::add_check_points(const PlacedLevel& at, std::span<const Point<World>> to_check,
                                    render::Scene& scene) {
  std::size_t k = 0;
  if (!to_check.empty()) {
    add_place_to_check(scene, to_float3(to_check.front().v),
                       label_of(HologramKind::kCheckPoint, ++k));
  }
  const std::vector<nav::CheckPoint>& touched = at.level->check_points;
  for (const nav::CheckPoint& point : touched) {
    const render::Label label = label_of(HologramKind::kCheckPoint, ++k);
    const render::Float3 place = to_float3(point.place.v);
    if (&point != &touched.back()) {
      add_earlier_check_point(scene, place, point.within, label);
    } else {
      add_check_point(scene, place, distance_text(point.distance_m), point.within, label);
    }
  }
}

}  // namespace orthonav::engine
