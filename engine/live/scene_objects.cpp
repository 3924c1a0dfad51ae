#include "engine/live/scene_objects.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "engine/holograms/shapes/hologram_label.h"
#include "engine/holograms/shapes/hologram_shapes.h"
#include "render/float3.h"
#include "render/projection.h"

namespace orthonav::engine {
namespace {

using render::Float3;

/// The most important first, because objects beyond the display's limits are left out from the end.
constexpr auto kOrder = [] {
  std::array<HologramKind, kHolograms.size()> order{};
  for (std::size_t i = 0; i < order.size(); ++i) {
    order[i] = static_cast<HologramKind>(i + 1);
  }
  std::sort(order.begin(), order.end(), [](HologramKind a, HologramKind b) {
    const auto rank = [](HologramKind kind) {
      return kHolograms[static_cast<std::size_t>(kind) - 1].rank;
    };
    return std::pair(rank(a), a) < std::pair(rank(b), b);
  });
  return order;
}();

constexpr float kLineWithin_m = 0.00012f;
constexpr float kPathWithin_m = 0.0007f;
constexpr float kPathCoarser = 2.0f;
constexpr float kCoarsestPath_m = 0.012f;
constexpr float kTubeWithin_m = 0.0002f;
/// More dashes of one line would not add information.
constexpr float kMaxDashes = 24;
/// A round end covers as much area as a flat one that ends this much sooner, in line widths.
constexpr float kRoundEnd = 0.5f - std::numbers::pi_v<float> / 8;
/// 1.5 px of a HoloLens 2 at 0.5 m, the least width the renderer draws too.
constexpr float kThinnest_m = 0.0004f;
constexpr float kOutline_m = 0.0005f;
constexpr float kBoneLine_m = 0.0006f;
constexpr float kFaintest = 0.02f;

/// Cuts a line into dashes: first a dash, then a gap of the same length. Dashes shorter than the
/// width are left out.
void cut_dashes(std::vector<StraightPiece>& pieces, float dash_m, float width_m) {
  float total_m = 0;
  for (const StraightPiece& piece : pieces) {
    total_m += length(piece[1] - piece[0]);
  }
  dash_m = std::max(dash_m, total_m / (2 * kMaxDashes));
  std::vector<StraightPiece> dashes;
  float gone_m = 0;
  for (const StraightPiece& piece : pieces) {
    const float length_m = length(piece[1] - piece[0]);
    const Float3 along = render::unit_or(piece[1] - piece[0], {0, 1, 0});
    for (float at_m = 0; at_m < length_m - 1e-6f;) {
      const float in_period_m = std::fmod(gone_m + at_m, 2 * dash_m);
      const bool is_dash = in_period_m < dash_m;
      const float step_m = std::max(
          1e-5f, std::min(length_m - at_m, (is_dash ? 1.0f : 2.0f) * dash_m - in_period_m));
      if (is_dash && step_m >= 0.99f * std::min(width_m, dash_m)) {
        const float inside_m = std::min(kRoundEnd * width_m, 0.4f * step_m);
        dashes.push_back(
            {piece[0] + (at_m + inside_m) * along, piece[0] + (at_m + step_m - inside_m) * along});
      }
      at_m += step_m;
    }
    gone_m += length_m;
  }
  pieces = std::move(dashes);
}

/// A line's ends are round and lie beyond its points; those of a cylinder are flat.
void lengthen(SurfaceContours::Line& line, float width_m, bool has_dashes) {
  if (line.size() < 2) {
    return;
  }
  const float by_m = (has_dashes ? 0.5f : 0.5f - kRoundEnd) * width_m;
  Float3& first = line.front();
  Float3& last = line.back();
  first = first + by_m * render::unit_or(first - line[1], {});
  last = last + by_m * render::unit_or(last - line[line.size() - 2], {});
}

std::vector<StraightPiece> pieces_of(const render::LineItem& item, float within_m) {
  SurfaceContours::Line line = item.points;
  if (item.closed && !line.empty()) {
    line.push_back(line.front());
  } else {
    lengthen(line, item.width_m, item.dash_m > 0);
  }
  std::vector<StraightPiece> pieces;
  append_pieces(thinned(line, within_m), pieces);
  if (item.dash_m > 0) {
    cut_dashes(pieces, item.dash_m, item.width_m);
  }
  return pieces;
}

}  // namespace

void SceneObjects::add_line(const render::LineItem& item,
                            const std::vector<StraightPiece>& pieces) {
  if (item.colour.a < kFaintest) {
    return;
  }
  for (const StraightPiece& piece : pieces) {
    writer_.add_piece(piece, std::max(item.width_m, kThinnest_m), item.colour);
  }
}

/// Only the cross's arrow: the deviation triangle's edges are lines already.
void SceneObjects::add_outline(const render::TriangleItem& item) {
  if (kind_of(item.label) != HologramKind::kCross) {
    return;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    writer_.add_piece({item.corners[i], item.corners[(i + 1) % 3]}, kOutline_m, item.colour);
  }
}

void SceneObjects::add_mesh(const render::MeshItem& item, Float3 eye, Timestamp shown_at) {
  const render::MeshData& mesh = *item.mesh;
  const render::Matrix4& m = item.world_from_model;
  if (mesh.axis.size() > 1) {
    SurfaceContours::Line line;
    for (const Float3 p : mesh.axis) {
      line.push_back(render::transformed(m, p));
    }
    std::vector<StraightPiece> pieces;
    append_pieces(thinned(line, kTubeWithin_m), pieces);
    for (const StraightPiece& piece : pieces) {
      writer_.add_piece(piece, 2 * mesh.axis_radius_m * scale_of(m), item.colour);
    }
    return;
  }
  if (mesh.indices.empty()) {
    return;
  }
  const HologramKind kind = kind_of(item.label);
  if (kind == HologramKind::kVertebra || kind == HologramKind::kTwin) {
    render::Colour line = look::colours().bone;
    line.a = 1;
    for (const StraightPiece& piece : bone_.pieces(item, eye, shown_at)) {
      writer_.add_piece(piece, kBoneLine_m, line);
    }
    return;
  }
  if (item.style == render::MeshStyle::kRim) {
    return;  // a halo
  }
  // Balls and diamonds are meshes of radius 1.
  writer_.add_ball(Float3(m[3]), scale_of(m), item.colour,
                   kind == HologramKind::kCheckPoint ? ObjectShape::kCube : ObjectShape::kSphere);
}

/// Doubles the tolerance while there are too many pieces and keeps it until the paths are gone:
/// going back would move every path.
std::vector<std::vector<StraightPiece>> SceneObjects::thinned_paths(const render::Scene& scene) {
  path_within_m_ = std::max(path_within_m_, kPathWithin_m);
  for (;; path_within_m_ *= kPathCoarser) {
    std::size_t count = 0;
    std::vector<std::vector<StraightPiece>> paths;
    for (const render::LineItem& item : scene.lines) {
      if (kind_of(item.label) == HologramKind::kPath) {
        count += paths.emplace_back(pieces_of(item, path_within_m_)).size();
      }
    }
    if (paths.empty()) {
      path_within_m_ = kPathWithin_m;
    }
    if (count <= options_.path_pieces || path_within_m_ >= kCoarsestPath_m) {
      return paths;
    }
  }
}

void SceneObjects::write(const render::Scene& scene, const render::Head& head, Timestamp shown_at,
                         ObjectList& list) {
  list.objects.clear();
  writer_.begin(list);
  auto paths = thinned_paths(scene);
  auto path = paths.begin();
  for (const HologramKind kind : kOrder) {
    const auto for_each = [&](const auto& items, const auto& add) {
      for (const auto& item : items) {
        if (kind_of(item.label) == kind) {
          writer_.label(item.label);
          add(item);
        }
      }
    };
    for_each(scene.texts, [&](const auto& item) { writer_.add_text(item, head); });
    for_each(scene.lines, [&](const auto& item) {
      add_line(item,
               kind == HologramKind::kPath ? std::move(*path++) : pieces_of(item, kLineWithin_m));
    });
    for_each(scene.triangles, [&](const auto& item) { add_outline(item); });
    for_each(scene.meshes, [&](const auto& item) { add_mesh(item, head.position, shown_at); });
  }
  bone_.forget_unused();
  writer_.end();
}

}  // namespace orthonav::engine
