#include "engine/io/polygon.h"

#include <algorithm>
#include <optional>
#include <string>

namespace orthonav::engine {
namespace {

constexpr std::size_t kMaxCorners = 64;

/// Twice the area of a triangle, along its normal.
Vec3 area_m2(Vec3 a, Vec3 b, Vec3 c) { return (b - a).cross(c - a); }

/// A corner from which all others are visible, so that no triangle of a fan from there is flipped:
/// any corner of a triangle or of a convex face. `corner(i)` is the place of the i-th of n.
template <class Corner>
std::optional<std::size_t> corner_that_sees_all(std::size_t n, const Corner& corner) {
  Vec3 whole;
  for (std::size_t i = 1; i + 1 < n; ++i) {
    whole += area_m2(corner(0), corner(i), corner(i + 1));
  }
  for (std::size_t from = 0; from < n; ++from) {
    bool sees_all = true;
    for (std::size_t i = from + 1; i + 1 < from + n && sees_all; ++i) {
      sees_all = area_m2(corner(from), corner(i % n), corner((i + 1) % n)).dot(whole) >= 0.0;
    }
    if (sees_all) {
      return from;
    }
  }
  return std::nullopt;
}

}  // namespace

Status add_face(std::span<const std::uint32_t> corners, std::size_t first_vertex,
                nav::TriangleMesh& mesh) {
  const std::size_t n = corners.size();
  if (n < 3) {
    return {};
  }
  if (n > kMaxCorners) {
    return Error{"a face has " + std::to_string(n) + " corners, at most " +
                 std::to_string(kMaxCorners)};
  }
  const std::size_t vertices = mesh.vertices_m.size() - first_vertex;
  if (std::any_of(corners.begin(), corners.end(), [&](auto v) { return v >= vertices; })) {
    return Error{"a face names a vertex that is not there"};
  }
  const auto vertex = [&](std::size_t i) {
    return static_cast<std::uint32_t>(first_vertex + corners[i % n]);
  };
  const auto from =
      corner_that_sees_all(n, [&](std::size_t i) { return mesh.vertices_m[vertex(i)]; });
  if (!from) {
    return Error{"a face of " + std::to_string(n) +
                 " corners can't be cut into triangles from one of them"};
  }
  for (std::size_t i = *from + 1; i + 1 < *from + n; ++i) {
    mesh.triangles.push_back({vertex(*from), vertex(i), vertex(i + 1)});
  }
  return {};
}

}  // namespace orthonav::engine
