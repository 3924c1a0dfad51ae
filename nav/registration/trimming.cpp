#include "nav/registration/trimming.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "nav/geometry/triangle.h"

namespace orthonav::nav {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kGrid_m = 0.001;
/// A pointer doesn't approach a face at a flatter angle than this.
const double kFlattest = std::sin(10.0 * kDegree);
/// Islands smaller than this fraction of the visible area are slivers seen through gaps.
constexpr double kIslandFraction = 0.02;
constexpr double kSmallestCanal_m2 = 40e-6;

std::vector<Vec3> directions_from_behind() {
  std::vector<Vec3> directions;
  for (const double up : {0.0, 20.0, -20.0, 40.0, -40.0}) {
    for (const double aside : {0.0, 25.0, -25.0, 50.0, -50.0, 75.0, -75.0}) {
      directions.push_back({std::sin(aside * kDegree) * std::cos(up * kDegree),
                            std::cos(aside * kDegree) * std::cos(up * kDegree),
                            std::sin(up * kDegree)});
    }
  }
  return directions;
}

Triangle corners_of(const TriangleMesh& mesh, const std::array<std::uint32_t, 3>& t) {
  return {mesh.vertices_m[t[0]], mesh.vertices_m[t[1]], mesh.vertices_m[t[2]]};
}

bool is_visible(const SurfaceIndex& surface, const Triangle& triangle,
                const std::vector<Vec3>& directions) {
  constexpr double kLift_m = 1e-5;
  const Vec3 normal = triangle_normal(triangle);
  const Vec3 eye = (triangle[0] + triangle[1] + triangle[2]) / 3.0 + kLift_m * normal;
  return std::any_of(directions.begin(), directions.end(), [&](Vec3 direction) {
    return normal.dot(direction) > kFlattest && !surface.first_hit(eye, direction);
  });
}

/// The vertebra seen along its axis, one cell per square millimetre, marked as bone or outside; the
/// largest remaining region is the canal.
class AxialView {
 public:
  AxialView(const SurfaceIndex& surface, const Bounds& b)
      : low_(b.low),
        columns_(static_cast<int>((b.high.x - b.low.x) / kGrid_m) + 3),
        rows_(static_cast<int>((b.high.y - b.low.y) / kGrid_m) + 3),
        bone_or_seen_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), false) {
    for (int row = 0; row < rows_; ++row) {
      for (int column = 0; column < columns_; ++column) {
        bone_or_seen_[cell(column, row)] =
            surface
                .first_hit({b.low.x + (column - 0.5) * kGrid_m, y_of(row), b.low.z - kGrid_m},
                           {0, 0, 1})
                .has_value();
      }
    }
    flood(0, 0);  // the outside; the border is one free cell wide
  }

  /// The y of the front of the largest hole, or nothing when no canal is visible.
  std::optional<double> canal_front_m() {
    std::size_t largest = 0;
    std::optional<double> front_m;
    for (int row = 0; row < rows_; ++row) {
      for (int column = 0; column < columns_; ++column) {
        if (bone_or_seen_[cell(column, row)]) {
          continue;
        }
        const std::size_t size = flood(column, row);
        // Rows run from front to back: the first cell of a hole that is met is its front.
        if (size > largest) {
          largest = size, front_m = y_of(row);
        }
      }
    }
    if (static_cast<double>(largest) * kGrid_m * kGrid_m < kSmallestCanal_m2) {
      return std::nullopt;
    }
    return front_m;
  }

 private:
  [[nodiscard]] std::size_t cell(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }
  [[nodiscard]] double y_of(int row) const { return low_.y + (row - 0.5) * kGrid_m; }

  std::size_t flood(int column, int row) {
    std::size_t size = 0;
    pending_.assign(1, {column, row});
    while (!pending_.empty()) {
      const auto [c, r] = pending_.back();
      pending_.pop_back();
      if (c < 0 || r < 0 || c >= columns_ || r >= rows_ || bone_or_seen_[cell(c, r)]) {
        continue;
      }
      bone_or_seen_[cell(c, r)] = true;
      ++size;
      for (const auto& [dc, dr] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
        pending_.emplace_back(c + dc, r + dr);
      }
    }
    return size;
  }

  Vec3 low_;
  int columns_;
  int rows_;
  std::vector<bool> bone_or_seen_;
  std::vector<std::pair<int, int>> pending_;
};

void drop_islands(const TriangleMesh& mesh, std::vector<bool>& kept) {
  const std::vector<std::uint32_t> part = parts_of(mesh, kept);
  std::vector<double> area_m2(mesh.vertices_m.size(), 0.0);
  double total_m2 = 0.0;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    if (!kept[i]) {
      continue;
    }
    const double a = triangle_area_m2(corners_of(mesh, mesh.triangles[i]));
    area_m2[part[i]] += a;
    total_m2 += a;
  }
  for (std::size_t i = 0; i < kept.size(); ++i) {
    if (kept[i] && area_m2[part[i]] < kIslandFraction * total_m2) {
      kept[i] = false;
    }
  }
}

}  // namespace

std::vector<std::uint32_t> faces_reachable_from_behind(const TriangleMesh& mesh,
                                                       const SurfaceIndex& surface) {
  const double front_m = AxialView(surface, bounds_of(mesh))
                             .canal_front_m()
                             .value_or(-std::numeric_limits<double>::infinity());
  const std::vector<Vec3> directions = directions_from_behind();
  std::vector<bool> kept(mesh.triangles.size(), false);
  for (std::size_t i = 0; i < kept.size(); ++i) {
    const Triangle triangle = corners_of(mesh, mesh.triangles[i]);
    const double y_m = (triangle[0].y + triangle[1].y + triangle[2].y) / 3.0;
    kept[i] = y_m > front_m && is_visible(surface, triangle, directions);
  }
  drop_islands(mesh, kept);
  std::vector<std::uint32_t> faces;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    if (kept[i]) {
      faces.push_back(static_cast<std::uint32_t>(i));
    }
  }
  return faces;
}

bool is_visible_from_behind(const TriangleMesh& mesh, const SurfaceIndex& surface,
                            std::uint32_t face) {
  return is_visible(surface, corners_of(mesh, mesh.triangles[face]), directions_from_behind());
}

}  // namespace orthonav::nav
