#include <cmath>
#include <memory>

#include "base/length_text.h"
#include "engine/holograms/shapes/hologram_parts.h"
#include "engine/holograms/shapes/hologram_shapes.h"
#include "render/shapes.h"

namespace orthonav::engine {
namespace {

constexpr float kDiamond_m = 0.004f;  // from tip to tip
constexpr float kHaloRadius_m = 0.005f;
constexpr float kEarlierDiamond_m = 0.002f;
constexpr float kEarlierLight = 0.35f;  // of the newest one's

std::shared_ptr<const render::MeshData> diamond() {
  static const auto mesh = std::make_shared<const render::MeshData>(render::make_octahedron(1.0f));
  return mesh;
}

/// The halo is a bubble of which only the rim shows: a ring from every side.
void add_diamond_in_halo(render::Scene& scene, render::Float3 centre, render::Colour colour,
                         render::Label label) {
  add_mesh(scene, diamond(), render::placed_at(centre, 0.5f * kDiamond_m), colour, label);
  add_sphere(scene, centre, kHaloRadius_m, colour, label);
  scene.meshes.back().style = render::MeshStyle::kRim;
}

}  // namespace

std::string distance_text(double distance_m) {
  return std::isfinite(distance_m) ? in_mm(std::abs(distance_m)) : "-- mm";
}

void add_check_point(render::Scene& scene, render::Float3 position, std::string_view text,
                     bool within, render::Label label) {
  const render::Colour colour = within ? look::colours().good : look::colours().poor;
  add_diamond_in_halo(scene, position, colour, label);
  render::TextItem& item = add_text_beside(scene, position, 1.5f, 0.0045f, 0.5f, label);
  if (!within) {
    item.rim = look::colours().poor;
  }
  add_run(item, text, look::kWhite);
  add_run(item, within ? " ✓" : " ✗", look::kWhite);
}

void add_earlier_check_point(render::Scene& scene, render::Float3 position, bool within,
                             render::Label label) {
  if (!within) {
    return add_diamond_in_halo(scene, position, look::colours().poor, label);
  }
  // Dim and not translucent: the bone would hide a translucent one.
  render::Colour colour = look::colours().good;
  colour.r *= kEarlierLight;
  colour.g *= kEarlierLight;
  colour.b *= kEarlierLight;
  add_mesh(scene, diamond(), render::placed_at(position, 0.5f * kEarlierDiamond_m), colour, label);
}

void add_place_to_stroke(render::Scene& scene, render::Float3 position, render::Label label) {
  add_sphere(scene, position, 1.6f * kHaloRadius_m, look::colours().placed, label);
  scene.meshes.back().style = render::MeshStyle::kRim;
}

void add_place_to_check(render::Scene& scene, render::Float3 position, render::Label label) {
  add_diamond_in_halo(scene, position, look::colours().placed, label);
}

}  // namespace orthonav::engine
