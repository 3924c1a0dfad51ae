#include "render/shapes.h"

#include <algorithm>
#include <array>
#include <numbers>

#include "render/float3.h"

namespace orthonav::render {
namespace {

constexpr float kTau = 2.0f * std::numbers::pi_v<float>;
constexpr int kMostSlices = 1024;

/// Angle at corner `a` of a triangle, rad.
float corner_angle_rad(Float3 a, Float3 b, Float3 c) {
  const Float3 u = b - a;
  const Float3 v = c - a;
  return std::atan2(length(cross(u, v)), dot(u, v));
}

void add_triangle(MeshData& mesh, std::size_t a, std::size_t b, std::size_t c) {
  for (const std::size_t i : {a, b, c}) {
    mesh.indices.push_back(static_cast<std::uint32_t>(i));
  }
}

/// Points of a path that differ from their predecessor; empty when any is not finite.
std::vector<Float3> distinct(std::span<const Float3> path) {
  std::vector<Float3> kept;
  for (const Float3 point : path) {
    if (!is_finite(point)) {
      return {};
    }
    if (kept.empty() || length(point - kept.back()) > 1e-7f) {
      kept.push_back(point);
    }
  }
  return kept;
}

Float3 tangent_at(const std::vector<Float3>& path, std::size_t i) {
  const Float3 before = i > 0 ? unit_or(path[i] - path[i - 1], {}) : Float3{};
  const Float3 after = i + 1 < path.size() ? unit_or(path[i + 1] - path[i], {}) : Float3{};
  return unit_or(before + after, i > 0 ? before : after);
}

void add_cap(MeshData& mesh, Float3 centre, Float3 outward, std::size_t ring, std::size_t slices) {
  const std::size_t middle = mesh.positions.size();
  mesh.positions.push_back(centre);
  mesh.normals.push_back(outward);
  for (std::size_t k = 0; k < slices; ++k) {
    mesh.positions.push_back(mesh.positions[ring + k]);
    mesh.normals.push_back(outward);
  }
  const Float3 u = mesh.positions[ring] - centre;
  const Float3 v = mesh.positions[ring + 1] - centre;
  const bool forward = dot(cross(u, v), outward) > 0;
  for (std::size_t k = 0; k < slices; ++k) {
    const std::size_t a = middle + 1 + k;
    const std::size_t b = middle + 1 + (k + 1) % slices;
    forward ? add_triangle(mesh, middle, a, b) : add_triangle(mesh, middle, b, a);
  }
}

}  // namespace

std::vector<Float3> smooth_normals(std::span<const Float3> positions,
                                   std::span<const std::uint32_t> indices) {
  std::vector<Float3> normals(positions.size());
  for (std::size_t t = 0; t + 2 < indices.size(); t += 3) {
    const std::array<std::size_t, 3> i = {indices[t], indices[t + 1], indices[t + 2]};
    if (*std::max_element(i.begin(), i.end()) >= positions.size()) {
      continue;
    }
    const Float3 face =
        unit_or(cross(positions[i[1]] - positions[i[0]], positions[i[2]] - positions[i[0]]), {});
    for (std::size_t k = 0; k < 3; ++k) {
      const float weight =
          corner_angle_rad(positions[i[k]], positions[i[(k + 1) % 3]], positions[i[(k + 2) % 3]]);
      normals[i[k]] = normals[i[k]] + weight * face;
    }
  }
  for (Float3& normal : normals) {
    normal = unit_or(normal, {0, 0, 1});
  }
  return normals;
}

MeshData make_sphere(float radius_m, int slices, int stacks) {
  MeshData mesh;
  if (!(radius_m > 0) || !std::isfinite(radius_m)) {
    return mesh;
  }
  const auto columns = static_cast<std::size_t>(std::clamp(slices, 3, kMostSlices));
  const auto rows = static_cast<std::size_t>(std::clamp(stacks, 2, kMostSlices));
  for (std::size_t r = 0; r <= rows; ++r) {
    const float polar = 0.5f * kTau * static_cast<float>(r) / static_cast<float>(rows);
    for (std::size_t c = 0; c < columns; ++c) {
      const float angle_rad = kTau * static_cast<float>(c) / static_cast<float>(columns);
      // The poles exactly, so that the surface closes.
      const float ring = r == 0 || r == rows ? 0.0f : std::sin(polar);
      const Float3 n = {ring * std::cos(angle_rad), std::cos(polar), ring * std::sin(angle_rad)};
      mesh.normals.push_back(n);
      mesh.positions.push_back(radius_m * n);
    }
  }
  for (std::size_t r = 0; r < rows; ++r) {
    for (std::size_t c = 0; c < columns; ++c) {
      const std::size_t next = (c + 1) % columns;
      const std::size_t a = r * columns + c;
      const std::size_t b = r * columns + next;
      const std::size_t below_a = a + columns;
      const std::size_t below_b = b + columns;
      if (r > 0) {
        add_triangle(mesh, a, b, below_a);
      }
      if (r + 1 < rows) {
        add_triangle(mesh, b, below_b, below_a);
      }
    }
  }
  return mesh;
}

MeshData make_octahedron(float radius_m) {
  MeshData mesh;
  if (!(radius_m > 0) || !std::isfinite(radius_m)) {
    return mesh;
  }
  for (const float x : {1.0f, -1.0f}) {
    for (const float y : {1.0f, -1.0f}) {
      for (const float z : {1.0f, -1.0f}) {
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        mesh.positions.push_back({x * radius_m, 0, 0});
        mesh.positions.push_back({0, y * radius_m, 0});
        mesh.positions.push_back({0, 0, z * radius_m});
        const float third = 1.0f / std::sqrt(3.0f);
        mesh.normals.insert(mesh.normals.end(), 3, {x * third, y * third, z * third});
        const bool outward = x * y * z > 0;
        mesh.indices.insert(mesh.indices.end(),
                            {first, first + (outward ? 1 : 2), first + (outward ? 2 : 1)});
      }
    }
  }
  return mesh;
}

MeshData make_cylinder(Float3 from, Float3 to, float radius_m, int slices) {
  const std::array<Float3, 2> path = {from, to};
  return make_tube(path, radius_m, slices);
}

MeshData make_tube(std::span<const Float3> path, float radius_m, int slices) {
  MeshData mesh;
  const std::vector<Float3> points = distinct(path);
  if (points.size() < 2 || !(radius_m > 0) || !std::isfinite(radius_m)) {
    return mesh;
  }
  const auto columns = static_cast<std::size_t>(std::clamp(slices, 3, kMostSlices));
  Float3 side = any_perpendicular(tangent_at(points, 0));
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Float3 along = tangent_at(points, i);
    side = unit_or(side - dot(side, along) * along, any_perpendicular(along));
    const Float3 up = cross(along, side);
    for (std::size_t k = 0; k < columns; ++k) {
      const float angle_rad = kTau * static_cast<float>(k) / static_cast<float>(columns);
      const Float3 normal = std::cos(angle_rad) * side + std::sin(angle_rad) * up;
      mesh.normals.push_back(normal);
      mesh.positions.push_back(points[i] + radius_m * normal);
    }
  }
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    for (std::size_t k = 0; k < columns; ++k) {
      const std::size_t a = i * columns + k;
      const std::size_t b = i * columns + (k + 1) % columns;
      add_triangle(mesh, a, b, a + columns);
      add_triangle(mesh, b, b + columns, a + columns);
    }
  }
  add_cap(mesh, points.front(), -1.0f * tangent_at(points, 0), 0, columns);
  add_cap(mesh, points.back(), tangent_at(points, points.size() - 1), (points.size() - 1) * columns,
          columns);
  mesh.axis = points;
  mesh.axis_radius_m = radius_m;
  return mesh;
}

void set_ring(std::vector<Float3>& ring, Float3 centre, Float3 normal, float radius_m, int points) {
  ring.clear();
  if (!(radius_m > 0) || !std::isfinite(radius_m) || !is_finite(centre)) {
    return;
  }
  const Float3 axis = unit_or(normal, {0, 1, 0});
  const Float3 side = any_perpendicular(axis);
  const Float3 up = cross(axis, side);
  const int count = std::clamp(points, 3, kMostSlices);
  for (int k = 0; k < count; ++k) {
    const float angle_rad = kTau * static_cast<float>(k) / static_cast<float>(count);
    ring.push_back(centre + (radius_m * std::cos(angle_rad)) * side +
                   (radius_m * std::sin(angle_rad)) * up);
  }
}

std::vector<Float3> make_ring(Float3 centre, Float3 normal, float radius_m) {
  std::vector<Float3> ring;
  set_ring(ring, centre, normal, radius_m);
  return ring;
}

Matrix4 placed_at(Float3 position, float scale) {
  return {{scale, 0, 0, 0}, {0, scale, 0, 0}, {0, 0, scale, 0}, Float4(position, 1)};
}

}  // namespace orthonav::render
