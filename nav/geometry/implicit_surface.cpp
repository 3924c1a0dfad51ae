#include "nav/geometry/implicit_surface.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "nav/geometry/dual_cells.h"
#include "nav/geometry/sample_grid.h"

namespace orthonav::nav {
namespace {

constexpr int kEveningRounds = 4;
constexpr int kFinalSteps = 3;

/// Two triangles over the shorter diagonal, in the order given.
void add_quad(const std::array<std::uint32_t, 4>& q, TriangleMesh& mesh) {
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
void join_vertices(const SampleGrid& grid, const CellMap& map, TriangleMesh& mesh) {
  constexpr std::array<std::pair<int, int>, 4> kAround = {{{-1, -1}, {0, -1}, {0, 0}, {-1, 0}}};
  for (const SurfaceCell& cell : map.cells) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      // Each edge is taken from the one cell whose lowest corner it starts at.
      if (!cell.crossed[edge_id(axis, 0, 0)]) {
        continue;
      }
      const std::size_t first = (axis + 1) % 3;
      const std::size_t second = (axis + 2) % 3;
      if (cell.at[first] == 0 || cell.at[second] == 0) {
        continue;
      }
      std::array<std::uint32_t, 4> quad{};
      for (std::size_t corner = 0; corner < 4; ++corner) {
        const auto [along_first, along_second] = kAround[corner];
        const SurfaceCell& around =
            map.at(grid, stepped(stepped(cell.at, first, along_first), second, along_second));
        const std::size_t edge = edge_id(axis, static_cast<std::size_t>(-along_first),
                                         static_cast<std::size_t>(-along_second));
        quad[corner] = around.first_vertex + around.sheet[edge];
      }
      if (!grid.inside(cell.at)) {
        std::swap(quad[1], quad[3]);
      }
      add_quad(quad, mesh);
    }
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
  if (slope < 1e-6) {
    return p;
  }
  const Vec3 move = gradient * (-value / slope);
  const double length = move.norm();
  return length > 0.5 * step ? p + move * (0.5 * step / length) : p + move;
}

/// Moves every vertex to the middle of its neighbours, then back onto the surface.
void even_out(const ImplicitFunction& function, double step, TriangleMesh& mesh) {
  std::vector<Vec3> sum(mesh.vertices_m.size());
  std::vector<int> count(mesh.vertices_m.size(), 0);
  for (const auto& triangle : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      sum[triangle[k]] +=
          mesh.vertices_m[triangle[(k + 1) % 3]] + mesh.vertices_m[triangle[(k + 2) % 3]];
      count[triangle[k]] += 2;
    }
  }
  for (std::size_t i = 0; i < mesh.vertices_m.size(); ++i) {
    mesh.vertices_m[i] = stepped_onto(
        function, 0.5 * mesh.vertices_m[i] + 0.5 * (sum[i] / std::max(count[i], 1)), step);
  }
}

}  // namespace

TriangleMesh surface_of(const ImplicitFunction& inside_negative, Vec3 low_m, Vec3 high_m,
                        double step_m) {
  const SampleGrid grid(inside_negative, low_m, high_m, step_m);
  TriangleMesh mesh;
  join_vertices(grid, passed_cells(grid, mesh), mesh);
  for (int round = 0; round < kEveningRounds; ++round) {
    even_out(inside_negative, step_m, mesh);
  }
  for (int round = 0; round < kFinalSteps; ++round) {
    for (Vec3& v : mesh.vertices_m) {
      v = stepped_onto(inside_negative, v, step_m);
    }
  }
  return mesh;
}

}  // namespace orthonav::nav
