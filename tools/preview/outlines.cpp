#include "tools/preview/outlines.h"

#include <array>
#include <utility>

#include "engine/holograms/shapes/hologram_parts.h"
#include "engine/holograms/shapes/render_values.h"

namespace orthonav::preview {
namespace {

constexpr render::Label kNoHologram = 9000;
/// A colour that no hologram has.
constexpr render::Colour kToolColour{0.85f, 0.20f, 0.75f, 1.0f};
constexpr render::Colour kHeadColour{0.45f, 0.45f, 0.50f, 1.0f};
constexpr float kWidth_m = 0.0012f;
/// How far in front of the eyes the frame of their view is drawn.
constexpr double kBefore_m = 0.08;

void add_line(render::Scene& scene, const std::vector<render::Float3>& points,
              render::Colour colour, bool closed) {
  engine::add_line(scene, points, kWidth_m, colour, kNoHologram, 0, closed);
}

void add_tool(const ToolSeen& tool, render::Scene& scene) {
  std::vector<render::Float3> corners;
  for (const Point<World>& corner : tool.tag_in_world) {
    corners.push_back(engine::to_float3(corner.v));
  }
  add_line(scene, corners, kToolColour, true);
  const Vec3 middle = 0.5 * (tool.tag_in_world[0].v + tool.tag_in_world[2].v);
  add_line(scene, {engine::to_float3(middle), engine::to_float3(tool.tip_in_world.v)}, kToolColour,
           false);
  render::TextItem& name = scene.texts.emplace_back();
  name.label = kNoHologram;
  engine::add_run(name, tool.name, kToolColour);
  name.position = engine::to_float3(0.5 * (tool.tag_in_world[0].v + tool.tag_in_world[1].v));
  name.min_height_deg = 0.6f;
  name.offset_up = 1.0f;
}

void add_head(const Transform<World, Rig>& world_from_rig, render::Scene& scene) {
  const double side = 0.5 * kBefore_m;
  const std::array<Vec3, 4> corners = {{{-side, side, -kBefore_m},
                                        {side, side, -kBefore_m},
                                        {side, -side, -kBefore_m},
                                        {-side, -side, -kBefore_m}}};
  const render::Float3 eye = engine::to_float3(world_from_rig.translation());
  std::vector<render::Float3> frame;
  for (const Vec3& corner : corners) {
    frame.push_back(engine::to_float3((world_from_rig * Point<Rig>{corner}).v));
    add_line(scene, {eye, frame.back()}, kHeadColour, false);
  }
  add_line(scene, frame, kHeadColour, true);
}

}  // namespace

void add_outlines(const Moment& moment, bool with_head, render::Scene& scene) {
  for (const ToolSeen& tool : moment.tools) {
    if (tool.status != PoseStatus::kLost) {
      add_tool(tool, scene);
    }
  }
  if (with_head) {
    add_head(moment.world_from_rig.value, scene);
  }
}

}  // namespace orthonav::preview
