#include "engine/live/surface_contours.h"

#include <algorithm>
#include <unordered_map>

#include "render/decimated.h"
#include "render/float3.h"
#include "render/thinned.h"

namespace orthonav::engine {
namespace {

using render::Float3;
using Line = SurfaceContours::Line;

/// A point of the contour lies on the surface, so occluders are searched from a little outside.
constexpr float kOffSurface_m = 0.0008f;
/// Hidden pieces no longer than this are shown, and visible ones no longer than this are not: such
/// pieces come from the triangles, not from the bone.
constexpr float kHiddenGap_m = 0.002f;
constexpr float kShortest_m = 0.004f;
/// At most this many points in a row are left out, which bounds the work.
constexpr std::size_t kLongestRun = 63;

nav::TriangleMesh to_nav(const render::MeshData& mesh) {
  nav::TriangleMesh out;
  for (const Float3 p : mesh.positions) {
    out.vertices_m.push_back({p.x, p.y, p.z});
  }
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    out.triangles.push_back({mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]});
  }
  return out;
}

/// The visible parts of a line: `seen[i]` tells about the piece from point i to the next.
void append_seen(const Line& line, std::vector<bool> seen, std::vector<Line>& lines) {
  const auto for_runs = [&](const auto& visit) {
    for (std::size_t first = 0; first < seen.size();) {
      std::size_t last = first;
      float run_m = 0;
      while (last < seen.size() && seen[last] == seen[first]) {
        run_m += length(line[last + 1] - line[last]);
        ++last;
      }
      visit(first, last, run_m);
      first = last;
    }
  };
  for_runs([&](std::size_t first, std::size_t last, float run_m) {
    if (!seen[first] && run_m < kHiddenGap_m) {
      std::fill(seen.begin() + static_cast<std::ptrdiff_t>(first),
                seen.begin() + static_cast<std::ptrdiff_t>(last), true);
    }
  });
  for_runs([&](std::size_t first, std::size_t last, float run_m) {
    if (seen[first] && run_m >= kShortest_m) {
      lines.emplace_back(line.begin() + static_cast<std::ptrdiff_t>(first),
                         line.begin() + static_cast<std::ptrdiff_t>(last) + 1);
    }
  });
}

/// Segments that share an edge, one after the other.
class Chains {
 public:
  explicit Chains(std::size_t segments) : used_(segments, false) {}
  void add(std::uint64_t edge, std::size_t segment) {
    auto& both = at_edge_.try_emplace(edge, std::array<std::size_t, 2>{kNone, kNone}).first->second;
    (both[0] == kNone ? both[0] : both[1]) = segment;
  }
  /// Takes the segment at this edge that is not taken yet; `kNone` if there is none.
  [[nodiscard]] std::size_t take_at(std::uint64_t edge) {
    const auto found = at_edge_.find(edge);
    for (const std::size_t segment : found->second) {
      if (segment != kNone && take(segment)) {
        return segment;
      }
    }
    return kNone;
  }
  bool take(std::size_t segment) {
    const bool was_used = used_[segment];
    used_[segment] = true;
    return !was_used;
  }
  static constexpr std::size_t kNone = ~std::size_t{0};

 private:
  std::unordered_map<std::uint64_t, std::array<std::size_t, 2>> at_edge_;
  std::vector<bool> used_;
};

}  // namespace

SurfaceContours::SurfaceContours(const render::MeshData& mesh, std::size_t most_triangles)
    : mesh_(render::decimated(mesh, most_triangles)), surface_(to_nav(mesh_)) {
  for (const Float3 p : mesh_.positions) {
    middle_ = middle_ + (1.0f / static_cast<float>(mesh_.positions.size())) * p;
  }
}

std::vector<SurfaceContours::Segment> SurfaceContours::segments_from(Float3 eye) const {
  std::vector<float> facing(mesh_.positions.size());
  for (std::size_t i = 0; i < facing.size(); ++i) {
    facing[i] = dot(mesh_.normals[i], eye - mesh_.positions[i]);
  }
  std::vector<Segment> segments;
  for (std::size_t t = 0; t + 2 < mesh_.indices.size(); t += 3) {
    Segment segment;
    std::size_t count = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      // From the lower index, so that both triangles of an edge find the same point.
      const auto [a, b] = std::minmax({mesh_.indices[t + k], mesh_.indices[t + (k + 1) % 3]});
      if ((facing[a] < 0) == (facing[b] < 0) || count == 2) {
        continue;
      }
      const float part = facing[a] / (facing[a] - facing[b]);
      segment[count++] = {
          std::uint64_t{a} << 32 | b,
          mesh_.positions[a] + part * (mesh_.positions[b] - mesh_.positions[a]),
          render::unit_or(mesh_.normals[a] + part * (mesh_.normals[b] - mesh_.normals[a]),
                          {0, 1, 0})};
    }
    if (count == 2) {
      segments.push_back(segment);
    }
  }
  return segments;
}

bool SurfaceContours::is_seen(const Segment& segment, Float3 eye) const {
  const Float3 middle = 0.5f * (segment[0].point + segment[1].point);
  const Float3 normal = 0.5f * (segment[0].normal + segment[1].normal);
  const Float3 from = middle + kOffSurface_m * (normal + render::unit_or(eye - middle, normal));
  const Float3 way = eye - from;
  const auto hit = surface_.first_hit({from.x, from.y, from.z}, {way.x, way.y, way.z});
  return !hit || hit->distance_m > static_cast<double>(length(way));
}

std::vector<Line> SurfaceContours::seen_from(Float3 eye) const {
  const std::vector<Segment> segments = segments_from(eye);
  Chains chains(segments.size());
  for (std::size_t i = 0; i < segments.size(); ++i) {
    chains.add(segments[i][0].edge, i);
    chains.add(segments[i][1].edge, i);
  }
  std::vector<Line> lines;
  for (std::size_t first = 0; first < segments.size(); ++first) {
    if (!chains.take(first)) {
      continue;
    }
    // On a closed surface every contour is closed, so following it one way is enough.
    Line line = {segments[first][0].point, segments[first][1].point};
    std::vector<bool> seen = {is_seen(segments[first], eye)};
    std::uint64_t edge = segments[first][1].edge;
    for (std::size_t next = chains.take_at(edge); next != Chains::kNone;
         next = chains.take_at(edge)) {
      const std::size_t end = segments[next][0].edge == edge ? 1 : 0;
      line.push_back(segments[next][end].point);
      seen.push_back(is_seen(segments[next], eye));
      edge = segments[next][end].edge;
    }
    append_seen(line, std::move(seen), lines);
  }
  std::stable_sort(lines.begin(), lines.end(),
                   [](const Line& a, const Line& b) { return length_of(a) > length_of(b); });
  return lines;
}

Line thinned(const Line& line, float within_m) {
  Line kept;
  render::append_needed(
      line, kLongestRun,
      [&](Float3 p, Float3 a, Float3 b) {
        return render::squared_distance_to_segment(p, a, b) <= within_m * within_m;
      },
      kept);
  return kept;
}

float length_of(const Line& line) {
  float sum = 0;
  for (std::size_t i = 1; i < line.size(); ++i) {
    sum += length(line[i] - line[i - 1]);
  }
  return sum;
}

}  // namespace orthonav::engine
