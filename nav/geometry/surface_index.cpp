#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/vectorized.h"
#include "nav/geometry/box_tree.h"
#include "nav/geometry/mesh.h"
#include "nav/geometry/triangle.h"

namespace orthonav::nav {
namespace {

using Lanes = BoxTree::Lanes;
constexpr double kInfinitelyFar = std::numeric_limits<double>::infinity();

/// How far the boxes of a node are from a place, in single precision.
class PlaceToBoxes {
 public:
  /// `farthest_m`: the largest coordinate of any box.
  PlaceToBoxes(Vec3 place_m, double farthest_m) {
    double largest_m = farthest_m;
    for (int axis = 0; axis < 3; ++axis) {
      largest_m = std::max(largest_m, std::abs(place_m[axis]));
      place_m_[static_cast<std::size_t>(axis)] =
          static_cast<float>(std::clamp(place_m[axis], -kBeyond_m, kBeyond_m));
    }
    rounding_m_ = largest_m < kBeyond_m ? kRounding * largest_m : kInfinitelyFar;
  }

  /// The largest key that a box within `within_m` can have, including rounding.
  [[nodiscard]] float limit_key(double within_m) const {
    const double m = (within_m + rounding_m_) * (1.0 + kRounding);
    return m < kBeyond_m ? static_cast<float>(4.0 * m * m) : std::numeric_limits<float>::infinity();
  }

  /// Keys are four times the squared distances.
  void operator()(const BoxTree::Node& node, Lanes& keys_m2) const {
    const auto [x, y, z] = place_m_;
    // Not std::max: GCC turns it into branches and does not vectorize the loop.
    const auto twice_outside = [](float centre, float half, float at) {
      const float beyond = std::abs(at - centre) - half;
      return beyond + std::abs(beyond);
    };
    ORTHONAV_VECTORIZED
    for (std::size_t i = 0; i < BoxTree::kWide; ++i) {
      const float dx = twice_outside(node.centre[0][i], node.half[0][i], x);
      const float dy = twice_outside(node.centre[1][i], node.half[1][i], y);
      const float dz = twice_outside(node.centre[2][i], node.half[2][i], z);
      keys_m2[i] = dx * dx + dy * dy + dz * dz;
    }
  }

 private:
  /// Several times the error of three roundings to single precision.
  static constexpr double kRounding = 1e-6;
  /// The square of a smaller number fits single precision.
  static constexpr double kBeyond_m = 1e15;

  std::array<float, 3> place_m_{};
  double rounding_m_;
};

/// How far along a ray the boxes of a node begin, or infinity.
class RayToBoxes {
 public:
  /// `nearest` is the nearest hit so far.
  RayToBoxes(Vec3 origin_m, Vec3 direction, const double& nearest)
      : origin_m_(origin_m), nearest_(nearest) {
    for (int axis = 0; axis < 3; ++axis) {
      // Not infinite: 0 · infinity would be NaN.
      inverse_[axis] = std::abs(direction[axis]) * kHuge > 1.0 ? 1.0 / direction[axis] : kHuge;
    }
  }

  void operator()(const BoxTree::Node& node, std::array<double, BoxTree::kWide>& entries) const {
    const Span whole{0.0, nearest_};
    ORTHONAV_VECTORIZED
    for (std::size_t i = 0; i < BoxTree::kWide; ++i) {
      const Span x = within(node, 0, i);
      const Span y = within(node, 1, i);
      const Span z = within(node, 2, i);
      const double entry = std::max(std::max(x.entry, y.entry), std::max(z.entry, whole.entry));
      const double exit = std::min(std::min(x.exit, y.exit), std::min(z.exit, whole.exit));
      entries[i] = entry <= exit ? entry : kInfinitelyFar;
    }
  }

 private:
  static constexpr double kRounding = 1e-12;
  static constexpr double kHuge = 1e200;

  struct Span {
    double entry;
    double exit;
  };
  /// Where the ray is between the two planes of a box across an axis.
  [[nodiscard]] Span within(const BoxTree::Node& node, int axis, std::size_t lane) const {
    const auto k = static_cast<std::size_t>(axis);
    const double middle = (node.centre[k][lane] - origin_m_[axis]) * inverse_[axis];
    const double reach = std::abs(node.half[k][lane] * inverse_[axis]);
    // Rounding must not cut off a hit that lies on the face of the box.
    const double wider = reach + kRounding * (std::abs(middle) + reach);
    return {middle - wider, middle + wider};
  }

  Vec3 origin_m_;
  Vec3 inverse_;  ///< 1 / direction
  const double& nearest_;
};

}  // namespace

SurfaceIndex::SurfaceIndex(const TriangleMesh& mesh) {
  std::vector<Triangle> triangles(mesh.triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      triangles[i][k] = mesh.vertices_m[mesh.triangles[i][k]];
    }
  }
  boxes_ = BoxTree(triangles, original_);
  corners_.reserve(triangles.size());
  for (const std::uint32_t i : original_) {
    corners_.push_back(triangles[i]);
  }
}

std::optional<SurfacePoint> SurfaceIndex::nearest(Vec3 query_m, double within_m) const {
  if (boxes_.empty() || !query_m.is_finite() || !(within_m >= 0.0)) {
    return std::nullopt;
  }
  double best2 = within_m * within_m;
  std::size_t best = corners_.size();
  Vec3 best_point;
  const PlaceToBoxes to_boxes(query_m, boxes_.farthest_m());
  float limit = to_boxes.limit_key(within_m);
  search_boxes<float>(boxes_.nodes(), to_boxes, limit, [&](std::size_t i) {
    const Vec3 point = nearest_on_triangle(query_m, corners_[i]);
    const double d2 = (point - query_m).squared_norm();
    const bool tie = d2 == best2 && (best == corners_.size() || original_[i] < original_[best]);
    if (d2 < best2 || tie) {
      best2 = d2, best = i, best_point = point;
      limit = to_boxes.limit_key(std::sqrt(d2));
    }
  });
  if (best == corners_.size()) {
    return std::nullopt;
  }
  return SurfacePoint{best_point, triangle_normal(corners_[best]), std::sqrt(best2),
                      original_[best]};
}

std::optional<RayHit> SurfaceIndex::first_hit(Vec3 origin_m, Vec3 direction) const {
  const double length = direction.norm();
  if (boxes_.empty() || !origin_m.is_finite() || !std::isfinite(length) || !(length > 0.0)) {
    return std::nullopt;
  }
  const Vec3 unit = direction / length;
  double best = kInfinitelyFar;
  std::size_t hit = corners_.size();
  // A box that the ray does not meet has an infinite key.
  double limit = std::numeric_limits<double>::max();
  search_boxes<double>(boxes_.nodes(), RayToBoxes(origin_m, unit, best), limit, [&](std::size_t i) {
    if (const auto t = ray_meets_triangle(origin_m, unit, corners_[i]);
        t && (*t < best || (*t == best && original_[i] < original_[hit]))) {
      best = *t, hit = i, limit = best;
    }
  });
  if (hit == corners_.size()) {
    return std::nullopt;
  }
  return RayHit{origin_m + best * unit, triangle_normal(corners_[hit]), best, original_[hit]};
}

bool SurfaceIndex::contains(Vec3 query_m) const {
  // Seen from inside, the first face along any ray is seen from its back. Three rays outvote one
  // that grazes an edge.
  constexpr std::array<Vec3, 3> kDirections = {
      {{0.8164, 0.3147, 0.4842}, {-0.2741, 0.9013, -0.3353}, {0.1372, -0.5329, -0.8350}}};
  const auto inside = [&](std::size_t i) {
    const auto hit = first_hit(query_m, kDirections[i]);
    return hit && hit->normal.dot(kDirections[i]) > 0.0;
  };
  const bool first = inside(0);
  return inside(1) == first ? first : inside(2);
}

bool SurfaceIndex::contains(Vec3 query_m, const SurfacePoint& nearest) const {
  // Beside an edge the nearest face alone does not tell the side.
  constexpr double kClear = 0.5;
  const double along_m = (query_m - nearest.point_m).dot(nearest.normal);
  return std::abs(along_m) > kClear * nearest.distance_m ? along_m < 0.0 : contains(query_m);
}

}  // namespace orthonav::nav
