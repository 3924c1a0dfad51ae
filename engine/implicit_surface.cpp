#include "engine/implicit_surface.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace orthonav::engine {
namespace {

constexpr std::uint32_t kNoVertex = 0xffffffff;
constexpr int kEveningRounds = 4;
constexpr int kFinalSteps = 3;

/// Values at the nodes of a regular grid; a cell has the index of its lowest corner.
class Grid {
 public:
  Grid(const ImplicitFunction& function, Vec3 low, Vec3 high, double step)
      : low_(low), step_(step) {
    for (int axis = 0; axis < 3; ++axis)
      size_[static_cast<std::size_t>(axis)] =
          static_cast<int>(std::ceil((high[axis] - low[axis]) / step)) + 1;
    values_.reserve(static_cast<std::size_t>(size_[0]) * static_cast<std::size_t>(size_[1]) *
                    static_cast<std::size_t>(size_[2]));
    for (int z = 0; z < size_[2]; ++z)
      for (int y = 0; y < size_[1]; ++y)
        for (int x = 0; x < size_[0]; ++x) values_.push_back(function(position(x, y, z)));
  }
  [[nodiscard]] Vec3 position(int x, int y, int z) const {
    return low_ + step_ * Vec3{double(x), double(y), double(z)};
  }
  [[nodiscard]] std::size_t index(int x, int y, int z) const {
    return (static_cast<std::size_t>(z) * static_cast<std::size_t>(size_[1]) +
            static_cast<std::size_t>(y)) *
               static_cast<std::size_t>(size_[0]) +
           static_cast<std::size_t>(x);
  }
  [[nodiscard]] double value(int x, int y, int z) const { return values_[index(x, y, z)]; }
  [[nodiscard]] bool inside(int x, int y, int z) const { return value(x, y, z) < 0.0; }
  [[nodiscard]] int size(std::size_t axis) const { return size_[axis]; }
  [[nodiscard]] std::size_t nodes() const { return values_.size(); }

 private:
  Vec3 low_;
  double step_;
  std::array<int, 3> size_{};
  std::vector<double> values_;
};

/// Mean of the places where the surface crosses the cell's twelve edges; false if it does not.
bool cell_vertex(const Grid& grid, int x, int y, int z, Vec3& vertex) {
  Vec3 sum;
  int crossings = 0;
  for (int axis = 0; axis < 3; ++axis)
    for (int corner = 0; corner < 4; ++corner) {
      std::array<int, 3> a = {x, y, z};
      a[static_cast<std::size_t>((axis + 1) % 3)] += corner & 1;
      a[static_cast<std::size_t>((axis + 2) % 3)] += corner >> 1;
      std::array<int, 3> b = a;
      ++b[static_cast<std::size_t>(axis)];
      const double va = grid.value(a[0], a[1], a[2]);
      const double vb = grid.value(b[0], b[1], b[2]);
      if ((va < 0.0) == (vb < 0.0)) continue;
      const Vec3 pa = grid.position(a[0], a[1], a[2]);
      sum += pa + va / (va - vb) * (grid.position(b[0], b[1], b[2]) - pa);
      ++crossings;
    }
  if (crossings > 0) vertex = sum / crossings;
  return crossings > 0;
}

std::vector<std::uint32_t> place_vertices(const Grid& grid, nav::TriangleMesh& mesh) {
  std::vector<std::uint32_t> vertex_of(grid.nodes(), kNoVertex);
  for (int z = 0; z + 1 < grid.size(2); ++z)
    for (int y = 0; y + 1 < grid.size(1); ++y)
      for (int x = 0; x + 1 < grid.size(0); ++x) {
        Vec3 vertex;
        if (!cell_vertex(grid, x, y, z, vertex)) continue;
        vertex_of[grid.index(x, y, z)] = static_cast<std::uint32_t>(mesh.vertices_m.size());
        mesh.vertices_m.push_back(vertex);
      }
  return vertex_of;
}

/// Two triangles over the shorter diagonal, in the order given.
void add_quad(const std::array<std::uint32_t, 4>& q, nav::TriangleMesh& mesh) {
  const auto length = [&](std::size_t a, std::size_t b) {
    return (mesh.vertices_m[q[a]] - mesh.vertices_m[q[b]]).squared_norm();
  };
  if (length(0, 2) <= length(1, 3)) {
    mesh.triangles.push_back({q[0], q[1], q[2]});
    mesh.triangles.push_back({q[0], q[2], q[3]});
  } else {
    mesh.triangles.push_back({q[0], q[1], q[3]});
    mesh.triangles.push_back({q[1], q[2], q[3]});
  }
}

/// One quad for each grid edge that the surface crosses, through the four cells around it.
void join_vertices(const Grid& grid, const std::vector<std::uint32_t>& vertex_of,
                   nav::TriangleMesh& mesh) {
  for (int z = 1; z + 1 < grid.size(2); ++z)
    for (int y = 1; y + 1 < grid.size(1); ++y)
      for (int x = 1; x + 1 < grid.size(0); ++x)
        for (std::size_t axis = 0; axis < 3; ++axis) {
          std::array<int, 3> end = {x, y, z};
          ++end[axis];
          const bool first_inside = grid.inside(x, y, z);
          if (first_inside == grid.inside(end[0], end[1], end[2])) continue;
          std::array<std::uint32_t, 4> quad{};
          constexpr std::array<std::pair<int, int>, 4> kAround = {
              {{-1, -1}, {0, -1}, {0, 0}, {-1, 0}}};
          for (std::size_t corner = 0; corner < 4; ++corner) {
            std::array<int, 3> cell = {x, y, z};
            cell[(axis + 1) % 3] += kAround[corner].first;
            cell[(axis + 2) % 3] += kAround[corner].second;
            quad[corner] = vertex_of[grid.index(cell[0], cell[1], cell[2])];
          }
          if (!first_inside) std::swap(quad[1], quad[3]);
          add_quad(quad, mesh);
        }
}

/// One Newton step towards the zero surface, at most half a grid step long.
Vec3 stepped_onto(const ImplicitFunction& function, Vec3 p, double step) {
  const double h = 1e-3 * step;
  const double value = function(p);
  const Vec3 gradient =
      Vec3{function(p + Vec3{h, 0, 0}) - value, function(p + Vec3{0, h, 0}) - value,
           function(p + Vec3{0, 0, h}) - value} /
      h;
  const double slope = gradient.squared_norm();
  if (slope < 1e-6) return p;
  const Vec3 move = gradient * (-value / slope);
  const double length = move.norm();
  return length > 0.5 * step ? p + move * (0.5 * step / length) : p + move;
}

/// Moves every vertex to the middle of its neighbours, then back onto the surface.
void even_out(const ImplicitFunction& function, double step, nav::TriangleMesh& mesh) {
  std::vector<Vec3> sum(mesh.vertices_m.size());
  std::vector<int> count(mesh.vertices_m.size(), 0);
  for (const auto& triangle : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      sum[triangle[k]] +=
          mesh.vertices_m[triangle[(k + 1) % 3]] + mesh.vertices_m[triangle[(k + 2) % 3]];
      count[triangle[k]] += 2;
    }
  for (std::size_t i = 0; i < mesh.vertices_m.size(); ++i)
    mesh.vertices_m[i] = stepped_onto(
        function, 0.5 * mesh.vertices_m[i] + 0.5 * (sum[i] / std::max(count[i], 1)), step);
}

}  // namespace

nav::TriangleMesh surface_of(const ImplicitFunction& inside_negative, Vec3 low_m, Vec3 high_m,
                             double step_m) {
  const Grid grid(inside_negative, low_m, high_m, step_m);
  nav::TriangleMesh mesh;
  join_vertices(grid, place_vertices(grid, mesh), mesh);
  for (int round = 0; round < kEveningRounds; ++round) even_out(inside_negative, step_m, mesh);
  for (int round = 0; round < kFinalSteps; ++round)
    for (Vec3& v : mesh.vertices_m) v = stepped_onto(inside_negative, v, step_m);
  return mesh;
}

}  // namespace orthonav::engine
