#include "bench/render_scene.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <utility>

#include "engine/golden/golden_scenes.h"
#include "render/decimated.h"
#include "render/float3.h"
#include "render/projection.h"
#include "render/shapes.h"

namespace orthonav::bench {
namespace {

using render::Float3;

constexpr std::size_t kTriangles = 32000;
constexpr int kSamples = 2000;
constexpr Float3 kSite = {0.0165f, 0.0320f, 0.0070f};

engine::GoldenScene golden(const char* name) {
  const std::vector<engine::GoldenScene> scenes = engine::golden_scenes();
  return *std::find_if(scenes.begin(), scenes.end(), [&](const auto& s) { return s.name == name; });
}

/// Every triangle cut into four at the midpoints of its edges.
render::MeshData refined(const render::MeshData& mesh) {
  render::MeshData out;
  out.positions = mesh.positions;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const auto [at, fresh] =
        middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(out.positions.size()));
    if (fresh) {
      out.positions.push_back(0.5f * (mesh.positions[a] + mesh.positions[b]));
    }
    return at->second;
  };
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const std::uint32_t a = mesh.indices[i], b = mesh.indices[i + 1], c = mesh.indices[i + 2];
    const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    for (const std::uint32_t index : {a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca}) {
      out.indices.push_back(index);
    }
  }
  out.normals = render::smooth_normals(out.positions, out.indices);
  return out;
}

/// Strokes over the lamina, as a surgeon makes them.
render::LineItem sampled_path() {
  render::LineItem line;
  line.label = 101;
  line.colour = {1.0f, 0.30f, 0.02f, 1};
  for (int i = 0; i < kSamples; ++i) {
    const float t = static_cast<float>(i) / (kSamples - 1);
    const float angle_rad = 24 * t * 2 * std::numbers::pi_v<float>;
    line.points.push_back({-0.020f + 0.016f * t + 0.0035f * std::cos(angle_rad),
                           0.038f + 0.004f * t,
                           0.004f - 0.010f * t + 0.005f * std::sin(angle_rad)});
  }
  return line;
}

/// H7: rings of 1, 2 and 5 mm that face the eyes, 60 mm above the site, and two dots.
void add_cross(render::Scene& scene, const std::vector<render::View>& views) {
  const Float3 centre = kSite + Float3{0, 0.060f, 0};
  const Float3 towards = render::unit_or(render::head_of(views).position - centre, {0, 1, 0});
  for (const float radius_m : {0.001f, 0.002f, 0.005f}) {
    render::LineItem ring;
    ring.label = 701;
    ring.points = render::make_ring(centre, towards, radius_m);
    ring.width_m = 0.0004f;
    ring.colour = {0.4f, 0.4f, 0.4f, 1};
    ring.closed = true;
    scene.lines.push_back(ring);
  }
  const auto dot = render::prepared(render::make_sphere(0.0006f));
  for (const float offset_m : {0.001f, -0.002f}) {
    render::MeshItem item;
    item.label = 701;
    item.mesh = dot;
    item.world_from_model = render::placed_at(centre + Float3{offset_m, 0, 0});
    item.colour = {1.0f, 0.42f, 0.0f, 1};
    scene.meshes.push_back(item);
  }
}

}  // namespace

FullScene full_scene() {
  const engine::GoldenScene guidance = golden("guidance");
  FullScene full{guidance.scene, guidance.views};
  // Guidance leaves the bone out; here it is drawn too, as it costs the most.
  const render::Scene verified = golden("verify").scene;
  render::MeshItem vertebra = *std::find_if(verified.meshes.begin(), verified.meshes.end(),
                                            [](const auto& item) { return item.label == 201; });
  vertebra.mesh = render::prepared(render::decimated(refined(*vertebra.mesh), kTriangles));
  full.scene.meshes.push_back(vertebra);
  const render::Scene rod = golden("h10_rod").scene;
  for (const auto& item : rod.meshes) {
    full.scene.meshes.push_back(item);
  }
  for (const auto& item : rod.lines) {
    full.scene.lines.push_back(item);
  }
  for (const auto& item : rod.texts) {
    full.scene.texts.push_back(item);
  }
  full.scene.lines.push_back(sampled_path());
  add_cross(full.scene, full.views);
  return full;
}

std::vector<render::View> swayed(const std::vector<render::View>& views, int frame) {
  std::vector<render::View> out = views;
  const float angle_rad = 0.1f * static_cast<float>(frame);
  for (render::View& view : out) {
    view.eye_from_world[3].x += 0.004f * std::cos(angle_rad);
    view.eye_from_world[3].y += 0.003f * std::sin(angle_rad);
  }
  return out;
}

}  // namespace orthonav::bench
