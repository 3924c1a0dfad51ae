#include "engine/holograms/shapes/hologram_parts.h"

#include <utility>

#include "render/decimated.h"
#include "render/shapes.h"

namespace orthonav::engine {

using render::Colour;
using render::Float3;
using render::Label;
using render::Scene;

Colour faded(Colour colour, float opacity) {
  colour.a *= opacity;
  return colour;
}

namespace {

/// One immutable sphere for all, so that the renderer keeps one copy of it.
const std::shared_ptr<const render::MeshData>& unit_sphere() {
  static const auto mesh = render::prepared(render::make_sphere(1.0f));
  return mesh;
}

}  // namespace

void add_mesh(Scene& scene, std::shared_ptr<const render::MeshData> mesh,
              const render::Matrix4& world_from_model, Colour colour, Label label) {
  render::MeshItem& item = scene.meshes.emplace_back();
  item.label = label;
  item.mesh = std::move(mesh);
  item.world_from_model = world_from_model;
  item.colour = colour;
}

void add_sphere(Scene& scene, Float3 centre, float radius_m, Colour colour, Label label) {
  add_mesh(scene, unit_sphere(), render::placed_at(centre, radius_m), colour, label);
}

void add_line(Scene& scene, std::span<const Float3> points, float width_m, Colour colour,
              Label label, float dash_m, bool closed) {
  render::LineItem& line = scene.lines.emplace_back();
  line.label = label;
  line.points.assign(points.begin(), points.end());
  line.width_m = width_m;
  line.colour = colour;
  line.dash_m = dash_m;
  line.closed = closed;
}

void add_ring(Scene& scene, Float3 centre, Float3 normal, float radius_m, float width_m,
              Colour colour, Label label, int points) {
  add_line(scene, {}, width_m, colour, label, 0, true);
  render::set_ring(scene.lines.back().points, centre, normal, radius_m, points);
}

render::TextItem& add_text_beside(Scene& scene, Float3 place, float offset_right, float height_m,
                                  float min_height_deg, Label label) {
  render::TextItem& text = scene.texts.emplace_back();
  text.label = label;
  text.position = place;
  text.align = offset_right < 0 ? render::TextAlign::kRight : render::TextAlign::kLeft;
  text.offset_right = offset_right;
  text.offset_up = -0.5f;
  text.height_m = height_m;
  text.min_height_deg = min_height_deg;
  return text;
}

std::string& add_run(render::TextItem& item, Colour colour) {
  render::TextRun& run = item.runs.emplace_back();
  run.colour = colour;
  return run.text;
}

void add_run(render::TextItem& item, std::string_view text, Colour colour) {
  add_run(item, colour) = text;
}

}  // namespace orthonav::engine
