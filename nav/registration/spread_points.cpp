#include "nav/registration/spread_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace orthonav::nav {
namespace {

constexpr double kSpreadCell_m = 0.004;
/// At most this fraction of the points is left out for lying in sparse cells.
constexpr double kLonelyFraction = 0.15;

/// The median of each coordinate, which outliers hardly move.
Vec3 middle_of(std::span<const Vec3> points_m) {
  Vec3 middle;
  std::vector<double> values(points_m.size());
  for (int axis = 0; axis < 3; ++axis) {
    for (std::size_t i = 0; i < points_m.size(); ++i) {
      values[i] = points_m[i][axis];
    }
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), at, values.end());
    middle[axis] = *at;
  }
  return middle;
}

/// Each next point is the one farthest from all before it.
void order_by_distance(std::vector<Vec3>& points_m, std::size_t count) {
  std::vector<double> distance2(points_m.size(), 1e9);
  for (std::size_t i = 0; i < std::min(count, points_m.size()); ++i) {
    std::size_t farthest = i;
    for (std::size_t k = i; k < points_m.size(); ++k) {
      if (distance2[k] > distance2[farthest]) {
        farthest = k;
      }
    }
    std::swap(points_m[i], points_m[farthest]);
    std::swap(distance2[i], distance2[farthest]);
    for (std::size_t k = i + 1; k < points_m.size(); ++k) {
      distance2[k] = std::min(distance2[k], (points_m[k] - points_m[i]).squared_norm());
    }
  }
}

struct Cell {
  Vec3 point;  ///< the first one in the cell
  std::size_t count = 0;
};

/// One point per cell within `reach_m` of the middle, in the order of the cells' places.
std::vector<Cell> cells_around(Vec3 middle, std::span<const Vec3> points_m, double reach_m) {
  std::map<std::array<long, 3>, Cell> by_place;
  for (const Vec3& p : points_m) {
    const Vec3 q = p - middle;
    if (!(q.norm() < reach_m)) {
      continue;
    }
    const auto place = [](double v) { return std::lround(v / kSpreadCell_m); };
    ++by_place.try_emplace({place(q.x), place(q.y), place(q.z)}, Cell{q}).first->second.count;
  }
  std::vector<Cell> cells;
  for (const auto& [place, cell] : by_place) {
    cells.push_back(cell);
  }
  return cells;
}

/// Drops sparse cells: outliers are few but far apart, so each would get a cell of its own.
void drop_isolated_cells(std::vector<Cell>& cells) {
  std::size_t all = 0;
  for (const Cell& cell : cells) {
    all += cell.count;
  }
  std::stable_sort(cells.begin(), cells.end(),
                   [](const Cell& a, const Cell& b) { return a.count > b.count; });
  auto droppable = static_cast<std::size_t>(kLonelyFraction * static_cast<double>(all));
  while (cells.size() > 6 && cells.back().count <= droppable &&
         2 * cells.back().count < cells[cells.size() / 2].count) {
    droppable -= cells.back().count;
    cells.pop_back();
  }
}

}  // namespace

SpreadPoints::SpreadPoints(std::span<const Vec3> points_m, double reach_m) {
  if (points_m.empty()) {
    return;
  }
  const Vec3 middle = middle_of(points_m);
  std::vector<Cell> cells = cells_around(middle, points_m, reach_m);
  drop_isolated_cells(cells);
  Vec3 mean;
  for (const Cell& cell : cells) {
    mean += cell.point / static_cast<double>(cells.size());
  }
  centre_m_ = middle + mean;
  for (const Cell& cell : cells) {
    if ((cell.point - mean).norm() < reach_m) {
      points_m_.push_back(cell.point - mean);
    }
  }
  constexpr std::size_t kOrdered = 150;
  order_by_distance(points_m_, kOrdered);
}

}  // namespace orthonav::nav
