#include "render/frame/surface_edges.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "render/float3.h"

namespace orthonav::render {
namespace {

/// A side of a triangle, from its lower end to its higher one.
struct Side {
  std::uint32_t low = 0;
  std::uint32_t high = 0;
  std::uint32_t triangle = 0;
  bool forward = true;                     ///< as the triangle goes round
  std::array<std::uint32_t, 2> corners{};  ///< in the mesh as given, at low and high
};

auto coordinates(Float3 p) { return std::tuple(p.x, p.y, p.z); }

/// For each vertex that is used, which of `positions` it lies at.
std::vector<std::uint32_t> welded(const MeshData& mesh, std::span<const std::uint32_t> indices,
                                  std::vector<Float3>& positions) {
  std::vector<std::uint32_t> order(indices.begin(), indices.end());
  std::sort(order.begin(), order.end());
  order.erase(std::unique(order.begin(), order.end()), order.end());
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return coordinates(mesh.positions[a]) < coordinates(mesh.positions[b]);
  });
  std::vector<std::uint32_t> place(mesh.positions.size());
  for (const std::uint32_t vertex : order) {
    if (positions.empty() || !(positions.back() == mesh.positions[vertex])) {
      positions.push_back(mesh.positions[vertex]);
    }
    place[vertex] = static_cast<std::uint32_t>(positions.size() - 1);
  }
  return place;
}

std::vector<Side> sides_of(std::span<const std::uint32_t> indices,
                           const std::vector<std::uint32_t>& place) {
  std::vector<Side> sides;
  sides.reserve(indices.size());
  for (std::size_t i = 0; i < indices.size(); ++i) {
    const auto triangle = static_cast<std::uint32_t>(i / 3);
    const std::uint32_t a = indices[i];
    const std::uint32_t b = indices[i % 3 == 2 ? i - 2 : i + 1];
    if (place[a] == place[b]) {
      continue;
    }
    if (place[a] < place[b]) {
      sides.push_back({place[a], place[b], triangle, true, {a, b}});
    } else {
      sides.push_back({place[b], place[a], triangle, false, {b, a}});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
  });
  return sides;
}

/// Whether the two sides of an edge are lit differently along all of it.
bool is_crease(const MeshData& mesh, const Side& a, const Side& b) {
  constexpr float kAlike = 0.99f;  // cosine of 8 degrees
  return dot(mesh.normals[a.corners[0]], mesh.normals[b.corners[0]]) < kAlike &&
         dot(mesh.normals[a.corners[1]], mesh.normals[b.corners[1]]) < kAlike;
}

/// Whether a triangle reaches above the plane of its neighbour.
bool is_hollow(const MeshData& mesh, std::span<const std::uint32_t> indices, const Float4& plane,
               const Side& neighbour) {
  float highest = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Float3 p = mesh.positions[indices[3 * neighbour.triangle + i]];
    highest = std::max(highest, plane.x * p.x + plane.y * p.y + plane.z * p.z + plane.w);
  }
  // Rounding must not hide an edge between triangles in one plane.
  constexpr float kFlat = 1e-3f;
  return highest >
         kFlat * (std::abs(plane.x) + std::abs(plane.y) + std::abs(plane.z)) *
             length(mesh.positions[neighbour.corners[1]] - mesh.positions[neighbour.corners[0]]);
}

/// A point of clip space as it lies in the image.
struct OnScreen {
  float x_px = 0;
  float y_px = 0;
  bool in_front = false;
};

OnScreen on_screen(const Matrix4& clip_from_model, PixelSize size, Float3 p) {
  const Float4 clip = clip_from_model * Float4(p, 1);
  const float depth = clip.w;
  if (!(depth > kNearPlane_m)) {
    return {};
  }
  return {(0.5f * clip.x / depth + 0.5f) * static_cast<float>(size.width_px),
          (0.5f * clip.y / depth + 0.5f) * static_cast<float>(size.height_px), true};
}

constexpr std::uint8_t kBothAxes = 3;

/// 1: it is drawn row by row; 2: column by column.
std::uint8_t axis_of(const Float4& edge) {
  return std::abs(edge.z - edge.x) < std::abs(edge.w - edge.y) ? 1 : 2;
}

/// Where an edge that is drawn row by row meets one that is drawn column by column, some pixels at
/// the corner lie beyond the ends of both.
Float4 lengthened(const Float4& edge, bool at_begin, bool at_end) {
  constexpr float kBeyond_px = 0.7f;
  const float x = edge.z - edge.x;
  const float y = edge.w - edge.y;
  const float part = kBeyond_px / std::max(std::abs(x), std::abs(y));
  const float before = at_begin ? part : 0;
  const float after = at_end ? part : 0;
  return {edge.x - before * x, edge.y - before * y, edge.z + after * x, edge.w + after * y};
}

/// Where the eye is in a model's own frame.
Float3 eye_in_model(const View& view, const Matrix4& world_from_model) {
  return transformed_back(view.eye_from_world * world_from_model, {0, 0, 0});
}

/// Whether each triangle faces the eye.
void find_faces(const std::vector<Float4>& planes, Float3 eye, std::vector<std::uint8_t>& faces) {
  faces.resize(planes.size());
  for (std::size_t i = 0; i < planes.size(); ++i) {
    const Float4& plane = planes[i];
    const float height = plane.x * eye.x + plane.y * eye.y + plane.z * eye.z + plane.w;
    faces[i] = height > 0 ? 1 : 0;
  }
}

}  // namespace

SurfaceEdges::SurfaceEdges(const MeshData& mesh, std::span<const std::uint32_t> indices) {
  const std::vector<std::uint32_t> place = welded(mesh, indices, positions_);
  for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
    const Float3 a = mesh.positions[indices[i]];
    const Float3 normal =
        cross(mesh.positions[indices[i + 1]] - a, mesh.positions[indices[i + 2]] - a);
    planes_.push_back({normal.x, normal.y, normal.z, -dot(normal, a)});
  }
  const std::vector<Side> sides = sides_of(indices, place);
  for (std::size_t i = 0; i < sides.size();) {
    const Side& a = sides[i];
    std::size_t alike = 1;
    while (i + alike < sides.size() && sides[i + alike].low == a.low &&
           sides[i + alike].high == a.high) {
      ++alike;
    }
    // Where more than two triangles meet, the first two stand for all.
    const Side& b = sides[alike > 1 ? i + 1 : i];
    const std::array<std::uint32_t, 2> ends = {a.low, a.high};
    edges_.push_back({a.forward ? ends : std::array{a.high, a.low},
                      {a.triangle, b.triangle},
                      is_crease(mesh, a, b),
                      is_hollow(mesh, indices, planes_[a.triangle], b)});
    i += alike;
  }
  // Euler: a sphere has two more corners and faces than edges.
  convex_ = positions_.size() + planes_.size() == edges_.size() + 2 &&
            std::none_of(edges_.begin(), edges_.end(), [](const Edge& edge) {
              return edge.hollow || edge.triangles[0] == edge.triangles[1];
            });
}

void SurfaceEdges::hide(const View& view, PixelSize size, const PlacedSurface& surface,
                        EdgeScratch& scratch, HiddenEdges& hidden) const {
  if (!convex_) {
    return;
  }
  const Matrix4 clip_from_model = clip_from_world(view) * surface.world_from_model;
  constexpr float kFar = std::numeric_limits<float>::max();
  Float4 box_px = {kFar, kFar, -kFar, -kFar};
  for (const Float3 p : positions_) {
    const OnScreen at = on_screen(clip_from_model, size, p);
    if (!at.in_front) {
      return;
    }
    box_px = {std::min(box_px.x, at.x_px), std::min(box_px.y, at.y_px), std::max(box_px.z, at.x_px),
              std::max(box_px.w, at.y_px)};
  }
  hidden.add(surface, box_px);
  const Float3 eye = eye_in_model(view, surface.world_from_model);
  find_faces(planes_, eye, scratch.faces);
  for (std::size_t i = 0; i < planes_.size(); ++i) {
    if (scratch.faces[i] == 1) {
      hidden.add_plane(planes_[i]);
    }
  }
  for (const Edge& edge : edges_) {
    const std::uint8_t left = scratch.faces[edge.triangles[0]];
    if (left != scratch.faces[edge.triangles[1]]) {
      const Float3 from = positions_[edge.ends[1 - left]] - eye;
      const Float3 to = positions_[edge.ends[left]] - eye;
      const Float3 outward = cross(from, to);
      hidden.add_plane({outward.x, outward.y, outward.z, -dot(outward, eye)});
    }
  }
}

void SurfaceEdges::find_shown(const Matrix4& clip_from_model, PixelSize size,
                              EdgeScratch& scratch) const {
  const std::vector<std::uint8_t>& faces = scratch.faces;
  scratch.shown.clear();
  for (const Edge& edge : edges_) {
    const unsigned facing = faces[edge.triangles[0]] + faces[edge.triangles[1]];
    const bool border = edge.triangles[0] == edge.triangles[1];
    if (facing == 0 || (facing == 1 && edge.hollow) || (facing == 2 && !edge.crease && !border)) {
      continue;
    }
    const std::size_t begin = faces[edge.triangles[0]] == 1 ? 0 : 1;
    const std::array<std::uint32_t, 2> ends = {edge.ends[begin], edge.ends[1 - begin]};
    const OnScreen a = on_screen(clip_from_model, size, positions_[ends[0]]);
    const OnScreen b = on_screen(clip_from_model, size, positions_[ends[1]]);
    if (a.in_front && b.in_front && (a.x_px != b.x_px || a.y_px != b.y_px)) {
      scratch.shown.push_back({ends, {a.x_px, a.y_px, b.x_px, b.y_px}});
    }
  }
}

void SurfaceEdges::seen_by(const View& view, PixelSize size, const PlacedSurface& surface,
                           const HiddenEdges& hidden, EdgeScratch& scratch,
                           std::vector<Float4>& edges) const {
  const Matrix4& world_from_model = surface.world_from_model;
  find_faces(planes_, eye_in_model(view, world_from_model), scratch.faces);
  const Matrix4 clip_from = clip_from_world(view);
  find_shown(clip_from * world_from_model, size, scratch);
  scratch.axes.assign(positions_.size(), 0);
  for (const EdgeScratch::Shown& edge : scratch.shown) {
    scratch.axes[edge.ends[0]] |= axis_of(edge.at_px);
    scratch.axes[edge.ends[1]] |= axis_of(edge.at_px);
  }
  for (const EdgeScratch::Shown& edge : scratch.shown) {
    if (!hidden.may_hide(surface, edge.at_px)) {
      edges.push_back(lengthened(edge.at_px, scratch.axes[edge.ends[0]] == kBothAxes,
                                 scratch.axes[edge.ends[1]] == kBothAxes));
      continue;
    }
    scratch.parts.assign(1, {transformed(world_from_model, positions_[edge.ends[0]]),
                             transformed(world_from_model, positions_[edge.ends[1]])});
    hidden.leave_out(surface, edge.at_px, scratch.parts);
    for (const Segment3& part : scratch.parts) {
      const OnScreen a = on_screen(clip_from, size, part.from);
      const OnScreen b = on_screen(clip_from, size, part.to);
      edges.push_back({a.x_px, a.y_px, b.x_px, b.y_px});
    }
  }
}

}  // namespace orthonav::render
