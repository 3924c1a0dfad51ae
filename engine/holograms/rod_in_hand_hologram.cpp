#include "engine/holograms/rod_in_hand_hologram.h"

#include <utility>
#include <vector>

#include "base/translation.h"
#include "engine/holograms/hologram_colours.h"
#include "engine/holograms/hologram_parts.h"
#include "engine/holograms/render_values.h"
#include "engine/session/rod_wording.h"
#include "render/float3.h"
#include "render/shapes.h"

namespace orthonav::engine {
namespace {

using render::Float3;

constexpr float kMarkRadius_m = 0.0055f;
constexpr float kMarkWidth_m = 0.0012f;
constexpr float kTowards_m = 0.020f;
constexpr float kTowardsHead_m = 0.004f;
constexpr float kTextUp = 2.5f;  // in heights of the text
constexpr float kAxisWidth_m = 0.0008f;

/// From the mark's rim to where the far end goes.
void add_towards(render::Scene& scene, Float3 at, Float3 along, Float3 towards) {
  const render::Colour colour = look::colours().fair;
  const Float3 tip = at + kTowards_m * towards;
  const Float3 back = tip - kTowardsHead_m * towards;
  add_line(scene, {at + kMarkRadius_m * towards, tip}, kMarkWidth_m, colour, kRodInHandLabel);
  add_line(scene, {back + kTowardsHead_m * along, tip, back - kTowardsHead_m * along}, kMarkWidth_m,
           colour, kRodInHandLabel);
}

/// A text that is never left out.
std::string& add_rod_text(render::Scene& scene, Float3 at, float up, float height_m) {
  render::TextItem& text = scene.texts.emplace_back();
  text.label = kRodInHandLabel;
  text.position = at;
  text.offset_up = up;
  text.height_m = height_m;
  text.min_height_deg = 0.5f;
  return add_run(text, look::kWhite);
}

}  // namespace

std::shared_ptr<const render::MeshData> tube_of(const LyingRod& rod) {
  std::vector<Float3> path;
  for (const Point<World>& at : rod.axis) {
    path.push_back(to_float3(at.v));
  }
  return std::make_shared<const render::MeshData>(
      render::make_tube(path, static_cast<float>(0.5 * rod.diameter_m)));
}

void add_rod_in_hand(render::Scene& scene, const LyingRod& rod,
                     std::shared_ptr<const render::MeshData> tube) {
  add_mesh(scene, std::move(tube), render::kIdentity, look::colours().rod, kRodInHandLabel);
  scene.meshes.back().style = render::MeshStyle::kRim;
  add_line(scene, {}, kAxisWidth_m, look::colours().rod, kRodInHandLabel);
  for (const Point<World>& at : rod.axis) {
    scene.lines.back().points.push_back(to_float3(at.v));
  }
  add_rod_text(scene, to_float3(rod.axis.front().v), -kTextUp - 1.0f, 0.004f) =
      translated(words::kWhereStroked);
  if (rod.next) {
    const Float3 at = to_float3(rod.bend.at.v);
    const Float3 along = to_float3(rod.bend.along);
    add_ring(scene, at, along, kMarkRadius_m, kMarkWidth_m, look::colours().fair, kRodInHandLabel);
    if (rod.towards) {
      add_towards(scene, at, along, to_float3(*rod.towards));
    }
    append_next_bend(add_rod_text(scene, at, kTextUp, 0.005f), *rod.next);
  }
  if (rod.cut) {
    const Float3 at = to_float3(rod.cut->at.v);
    add_ring(scene, at, to_float3(rod.cut->along), kMarkRadius_m, kMarkWidth_m, look::kWhite,
             kRodInHandLabel);
    append_cut(add_rod_text(scene, at, -kTextUp - 1.0f, 0.005f), rod.cut_length_m);
  }
}

}  // namespace orthonav::engine
