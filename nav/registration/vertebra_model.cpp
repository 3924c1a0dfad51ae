#include "nav/registration/vertebra_model.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

#include "nav/geometry/triangle.h"

namespace orthonav::nav {

// ---------------------------------------------------------------------------------------------
// What a pointer can reach.

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kSeenCell_m = 0.001;
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
        columns_(static_cast<int>((b.high.x - b.low.x) / kSeenCell_m) + 3),
        rows_(static_cast<int>((b.high.y - b.low.y) / kSeenCell_m) + 3),
        bone_or_seen_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), false) {
    for (int row = 0; row < rows_; ++row) {
      for (int column = 0; column < columns_; ++column) {
        bone_or_seen_[cell(column, row)] = surface
                                               .first_hit({b.low.x + (column - 0.5) * kSeenCell_m,
                                                           y_of(row), b.low.z - kSeenCell_m},
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
    if (static_cast<double>(largest) * kSeenCell_m * kSeenCell_m < kSmallestCanal_m2) {
      return std::nullopt;
    }
    return front_m;
  }

 private:
  [[nodiscard]] std::size_t cell(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }
  [[nodiscard]] double y_of(int row) const { return low_.y + (row - 0.5) * kSeenCell_m; }

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

// ---------------------------------------------------------------------------------------------
// What the search looks up.

namespace {

constexpr double kFieldCell_m = 0.002;
constexpr double kFieldMargin_m = 0.014;
constexpr double kSearchCell_m = 0.002;
/// Costs of single points are truncated here: an outlier costs no more for being farther off.
constexpr double kFarthest_m = 0.010;
constexpr double kInsideFactor = 1.5;
constexpr double kCostPerM = 250.0 / (kInsideFactor * kFarthest_m);

}  // namespace

SearchField::SearchField(const TriangleMesh& reachable, const SurfaceIndex& reachable_surface,
                         const SurfaceIndex& bone)
    : reachable_bounds_(bounds_of(reachable)),
      field_(reachable, reachable_surface, bone, kFieldCell_m, kFieldMargin_m) {
  const double pad_m = kReach_m + 2.0 * kSearchCell_m;
  const Vec3 pad{pad_m, pad_m, pad_m};
  cells_.low_m = reachable_bounds_.low - pad;
  cells_.cell_m = kSearchCell_m;
  const Vec3 extent = reachable_bounds_.high + pad - cells_.low_m;
  for (std::size_t k = 0; k < 3; ++k) {
    cells_.size[k] = 1 + static_cast<int>(extent[static_cast<int>(k)] / kSearchCell_m);
  }
  // Padding: a run may reach past the end of the last row.
  cells_.cost.resize(static_cast<std::size_t>(cells_.slice() * cells_.size[2] + Cells::kRun));
  for (int z = 0; z < cells_.size[2]; ++z) {
    for (int y = 0; y < cells_.size[1]; ++y) {
      for (int x = 0; x < cells_.size[0]; ++x) {
        DistanceField::Value value;
        const bool near =
            field_.at(cells_.low_m + kSearchCell_m * Vec3{x + 0.5, y + 0.5, z + 0.5}, value);
        const double distance =
            near ? std::min(std::abs(value.distance_m), kFarthest_m) : kFarthest_m;
        const double factor = near && value.distance_m < 0.0 ? kInsideFactor : 1.0;
        cells_.cost[static_cast<std::size_t>(cells_.index(x, y, z))] =
            static_cast<std::uint8_t>(kCostPerM * factor * distance);
      }
    }
  }
}

// ---------------------------------------------------------------------------------------------
// The model.

namespace {

/// Weighted by area, so that a finely meshed corner counts only for its size.
PrincipalAxes axes_by_area(const TriangleMesh& mesh) {
  std::vector<Vec3> centres_m;
  std::vector<double> areas_m2;
  for (const auto& t : mesh.triangles) {
    const Triangle corners{mesh.vertices_m[t[0]], mesh.vertices_m[t[1]], mesh.vertices_m[t[2]]};
    centres_m.push_back((corners[0] + corners[1] + corners[2]) / 3.0);
    areas_m2.push_back(triangle_area_m2(corners));
  }
  return principal_axes(centres_m, areas_m2);
}

std::vector<std::uint32_t> all_faces(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> faces(mesh.triangles.size());
  std::iota(faces.begin(), faces.end(), 0U);
  return faces;
}

}  // namespace

Result<std::shared_ptr<const VertebraModel>> VertebraModel::prepare(TriangleMesh mesh, Bone bone) {
  auto checked = checked_bone(std::move(mesh), bone);
  if (!checked) {
    return checked.error();
  }
  SurfaceIndex surface(*checked);
  std::vector<std::uint32_t> faces = bone == Bone::kVertebra
                                         ? faces_reachable_from_behind(*checked, surface)
                                         : all_faces(*checked);
  if (faces.empty()) {
    return Error{
        "model has no surface that a pointer can reach from behind (+y): its axes must be "
        "LPS"};
  }
  return std::shared_ptr<const VertebraModel>(
      new VertebraModel(bone, std::move(*checked), std::move(surface), std::move(faces)));
}

VertebraModel::VertebraModel(Bone bone, TriangleMesh mesh, SurfaceIndex surface,
                             std::vector<std::uint32_t> reachable_faces)
    : bone_(bone),
      mesh_(std::move(mesh)),
      surface_(std::move(surface)),
      reachable_faces_(std::move(reachable_faces)),
      reachable_(part_of(mesh_, reachable_faces_)),
      reachable_surface_(reachable_),
      reachable_axes_(axes_by_area(reachable_)),
      search_field_(reachable_, reachable_surface_, surface_) {}

}  // namespace orthonav::nav
