#include "engine/live/bone_lines.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "render/float3.h"
#include "render/projection.h"

namespace orthonav::engine {
namespace {

using render::Float3;

constexpr float kCoarser = 1.5f;
constexpr float kCoarsest_m = 0.004f;

Float3 into_model(const render::Matrix4& m, Float3 in_world) {
  const Float3 d = in_world - Float3(m[3]);
  const float squared = scale_of(m) * scale_of(m);
  return {dot(Float3(m[0]), d) / squared, dot(Float3(m[1]), d) / squared,
          dot(Float3(m[2]), d) / squared};
}

}  // namespace

float scale_of(const render::Matrix4& m) { return length(Float3(m[0])); }

void append_pieces(const SurfaceContours::Line& line, std::vector<StraightPiece>& pieces) {
  for (std::size_t i = 1; i < line.size(); ++i) {
    pieces.push_back({line[i - 1], line[i]});
  }
}

BoneLines::Drawn& BoneLines::drawn_of(const render::MeshItem& item) {
  for (const auto& drawn : drawn_) {
    if (drawn->mesh == item.mesh && drawn->label == item.label) {
      return *drawn;
    }
  }
  return *drawn_.emplace_back(std::make_unique<Drawn>(item));
}

bool BoneLines::will_do(const Drawn& drawn, const render::MeshItem& item, Float3 eye,
                        Timestamp now) const {
  if (!drawn.found_at || now < *drawn.found_at) {
    return false;
  }
  if (now - *drawn.found_at < options_.at_most_every) {
    return true;
  }
  const Float3 middle = render::transformed(item.world_from_model, drawn.contours.middle());
  const Float3 before = drawn.eye - middle;
  const Float3 after = eye - middle;
  const float rotation_rad = std::atan2(length(cross(before, after)), dot(before, after));
  return drawn.world_from_model == item.world_from_model && rotation_rad < options_.rotation_rad &&
         std::abs(length(before) - length(after)) < options_.rotation_rad * length(before);
}

void BoneLines::find(Drawn& drawn, const render::MeshItem& item, Float3 eye) const {
  const render::Matrix4& world_from_model = item.world_from_model;
  const auto lines = drawn.contours.seen_from(into_model(world_from_model, eye));
  for (float within_m = options_.within_m; within_m < kCoarsest_m; within_m *= kCoarser) {
    drawn.pieces.clear();
    for (const SurfaceContours::Line& line : lines) {
      SurfaceContours::Line kept = thinned(line, within_m / scale_of(world_from_model));
      for (Float3& p : kept) {
        p = render::transformed(world_from_model, p);
      }
      append_pieces(kept, drawn.pieces);
    }
    if (drawn.pieces.size() <= options_.most_pieces) {
      return;
    }
  }
  drawn.pieces.resize(std::min(drawn.pieces.size(), options_.most_pieces));  // the longest lines
}

const std::vector<StraightPiece>& BoneLines::pieces(const render::MeshItem& item, Float3 eye,
                                                    Timestamp now) {
  Drawn& drawn = drawn_of(item);
  drawn.used = true;
  if (!will_do(drawn, item, eye, now)) {
    find(drawn, item, eye);
    drawn.world_from_model = item.world_from_model;
    drawn.eye = eye;
    drawn.found_at = now;
  }
  return drawn.pieces;
}

void BoneLines::forget_unused() {
  std::erase_if(drawn_, [](const auto& drawn) { return !std::exchange(drawn->used, false); });
}

}  // namespace orthonav::engine
