#include "nav/geometry/dual_cells.h"

#include <set>
#include <utility>

namespace orthonav::nav {
namespace {

constexpr std::uint32_t kNoVertex = 0xffffffff;

/// The four edges of a cell's face, and how the surface runs between them.
class Face {
 public:
  Face(const SampleGrid& grid, const SurfaceCell& cell, std::size_t normal, std::size_t side)
      : u_((normal + 1) % 3), v_((normal + 2) % 3), side_(side) {
    node_ = stepped(cell.at, normal, static_cast<int>(side));
    const std::array<int, 3> along_u = stepped(node_, u_);
    near_inside_ = grid.inside(node_);
    const bool far_inside = grid.inside(stepped(along_u, v_));
    const bool u_inside = grid.inside(along_u);
    const bool v_inside = grid.inside(stepped(node_, v_));
    ambiguous_ = near_inside_ == far_inside && u_inside == v_inside && near_inside_ != u_inside;
  }
  [[nodiscard]] bool ambiguous() const { return ambiguous_; }
  [[nodiscard]] const std::array<int, 3>& node() const { return node_; }
  [[nodiscard]] std::size_t along_u(std::size_t v) const { return edge_id(u_, v, side_); }
  [[nodiscard]] std::size_t along_v(std::size_t u) const { return edge_id(v_, side_, u); }
  /// For an ambiguous face: the edges along v that belong to the edges along u at v = 0 and 1, with
  /// the inside corners kept apart, or joined.
  [[nodiscard]] std::array<std::size_t, 2> partners(bool joined) const {
    const std::size_t first = near_inside_ != joined ? 0 : 1;
    return {along_v(first), along_v(1 - first)};
  }

 private:
  std::size_t u_;
  std::size_t v_;
  std::size_t side_;
  std::array<int, 3> node_{};
  bool near_inside_ = false;
  bool ambiguous_ = false;
};

/// Faces on which the inside corners are joined, by node and normal.
using JoinedFaces = std::set<std::pair<std::array<int, 3>, std::size_t>>;

void mark_crossed_edges(const SampleGrid& grid, SurfaceCell& cell) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t corner = 0; corner < 4; ++corner) {
      std::array<int, 3> node = stepped(cell.at, (axis + 1) % 3, static_cast<int>(corner & 1));
      node = stepped(node, (axis + 2) % 3, static_cast<int>(corner >> 1));
      cell.crossed[axis * 4 + corner] = grid.inside(node) != grid.inside(stepped(node, axis));
    }
  }
}

/// Numbers the sheets of a cell from 0 on, in the order of their first edges; returns how many.
std::uint32_t number_sheets(SurfaceCell& cell) {
  std::uint32_t count = 0;
  std::array<std::uint8_t, 12> number{};
  number.fill(0xff);
  for (std::size_t edge = 0; edge < 12; ++edge) {
    if (cell.crossed[edge]) {
      std::uint8_t& known = number[cell.sheet[edge]];
      if (known == 0xff) {
        known = static_cast<std::uint8_t>(count++);
      }
      cell.sheet[edge] = known;
    }
  }
  return count;
}

/// Groups the crossed edges of a cell into sheets of the surface; returns how many.
std::uint32_t find_sheets(const SampleGrid& grid, const JoinedFaces& joined, SurfaceCell& cell) {
  for (std::uint8_t edge = 0; edge < 12; ++edge) {
    cell.sheet[edge] = edge;
  }
  const auto unite = [&cell](std::size_t a, std::size_t b) {
    const std::uint8_t from = cell.sheet[a];
    const std::uint8_t to = cell.sheet[b];
    for (std::uint8_t& sheet : cell.sheet) {
      if (sheet == from) {
        sheet = to;
      }
    }
  };
  for (std::size_t normal = 0; normal < 3; ++normal) {
    for (std::size_t side = 0; side < 2; ++side) {
      const Face face(grid, cell, normal, side);
      if (face.ambiguous()) {
        const auto partners = face.partners(joined.contains({face.node(), normal}));
        unite(face.along_u(0), partners[0]);
        unite(face.along_u(1), partners[1]);
        continue;
      }
      std::size_t last = 12;
      for (const std::size_t edge :
           {face.along_u(0), face.along_u(1), face.along_v(0), face.along_v(1)}) {
        if (cell.crossed[edge]) {
          if (last < 12) {
            unite(edge, last);
          }
          last = edge;
        }
      }
    }
  }
  return number_sheets(cell);
}

CellMap marked_cells(const SampleGrid& grid) {
  CellMap map;
  map.cell_of.assign(grid.nodes(), kNoVertex);
  for (int z = 0; z + 1 < grid.size(2); ++z) {
    for (int y = 0; y + 1 < grid.size(1); ++y) {
      for (int x = 0; x + 1 < grid.size(0); ++x) {
        int inside = 0;
        for (int corner = 0; corner < 8; ++corner) {
          inside += grid.inside({x + (corner & 1), y + (corner >> 1 & 1), z + (corner >> 2)});
        }
        if (inside == 0 || inside == 8) {
          continue;
        }
        map.cell_of[grid.index({x, y, z})] = static_cast<std::uint32_t>(map.cells.size());
        map.cells.push_back({{x, y, z}, 0, {}, {}});
        mark_crossed_edges(grid, map.cells.back());
      }
    }
  }
  return map;
}

/// Two sheets that touch twice across one face would share an edge of four quads. Where both pairs
/// of an ambiguous face belong to one sheet on either side, pairing them the other way separates
/// them (Wenger 2013, "Isosurfaces", manifold dual contouring).
bool part_double_edges(const SampleGrid& grid, const CellMap& map, JoinedFaces& joined) {
  bool changed = false;
  for (const SurfaceCell& cell : map.cells) {
    for (std::size_t normal = 0; normal < 3; ++normal) {
      const Face face(grid, cell, normal, 0);
      if (!face.ambiguous() || cell.at[normal] == 0) {
        continue;
      }
      const SurfaceCell& other = map.at(grid, stepped(cell.at, normal, -1));
      const Face same(grid, other, normal, 1);
      const bool one_here = cell.sheet[face.along_u(0)] == cell.sheet[face.along_u(1)];
      const bool one_there = other.sheet[same.along_u(0)] == other.sheet[same.along_u(1)];
      if (one_here && one_there) {
        changed |= joined.insert({face.node(), normal}).second;
      }
    }
  }
  return changed;
}

Vec3 crossing(const SampleGrid& grid, const SurfaceCell& cell, std::size_t edge) {
  const std::size_t axis = edge / 4;
  std::array<int, 3> a = stepped(cell.at, (axis + 1) % 3, static_cast<int>(edge & 1));
  a = stepped(a, (axis + 2) % 3, static_cast<int>(edge >> 1 & 1));
  const std::array<int, 3> b = stepped(a, axis);
  const double va = grid.value(a);
  return grid.position(a) + va / (va - grid.value(b)) * (grid.position(b) - grid.position(a));
}

}  // namespace

CellMap passed_cells(const SampleGrid& grid, TriangleMesh& mesh) {
  CellMap map = marked_cells(grid);
  JoinedFaces joined;
  do {
    for (SurfaceCell& cell : map.cells) {
      find_sheets(grid, joined, cell);
    }
  } while (part_double_edges(grid, map, joined));
  for (SurfaceCell& cell : map.cells) {
    cell.first_vertex = static_cast<std::uint32_t>(mesh.vertices_m.size());
    const std::uint32_t sheets = find_sheets(grid, joined, cell);
    for (std::uint32_t sheet = 0; sheet < sheets; ++sheet) {
      Vec3 sum;
      int count = 0;
      for (std::size_t edge = 0; edge < 12; ++edge) {
        if (cell.crossed[edge] && cell.sheet[edge] == sheet) {
          sum += crossing(grid, cell, edge);
          ++count;
        }
      }
      mesh.vertices_m.push_back(sum / count);
    }
  }
  return map;
}

}  // namespace orthonav::nav
