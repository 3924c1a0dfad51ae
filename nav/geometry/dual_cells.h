#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "nav/geometry/mesh.h"
#include "nav/geometry/sample_grid.h"

namespace orthonav::nav {

/// The twelve edges of a cell: along `axis`, from the corner that lies `first` steps along the next
/// axis and `second` steps along the one after.
constexpr std::size_t edge_id(std::size_t axis, std::size_t first, std::size_t second) {
  return axis * 4 + first + 2 * second;
}

/// A cell that the surface passes through: its sheets, each with one vertex, and which edge belongs
/// to which sheet.
struct SurfaceCell {
  std::array<int, 3> at{};
  std::uint32_t first_vertex = 0;
  std::array<std::uint8_t, 12> sheet{};
  std::array<bool, 12> crossed{};
};

[[nodiscard]] inline std::array<int, 3> stepped(std::array<int, 3> node, std::size_t axis,
                                                int by = 1) {
  node[axis] += by;
  return node;
}

/// Cells by grid index.
struct CellMap {
  std::vector<std::uint32_t> cell_of;
  std::vector<SurfaceCell> cells;
  [[nodiscard]] const SurfaceCell& at(const SampleGrid& grid,
                                      const std::array<int, 3>& node) const {
    return cells[cell_of[grid.index(node)]];
  }
};

/// Finds every cell that the zero surface passes through, and adds one vertex per sheet to `mesh`:
/// the mean of the places where the sheet crosses the cell's edges.
[[nodiscard]] CellMap passed_cells(const SampleGrid& grid, TriangleMesh& mesh);

}  // namespace orthonav::nav
