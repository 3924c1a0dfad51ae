#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "nav/geometry/mesh.h"
#include "nav/geometry/triangle.h"

namespace orthonav::nav {
namespace {

constexpr std::size_t kLeafSize = 4;
/// Halving 2^32 triangles down to leaves can't go deeper than this.
constexpr std::size_t kStack = 40;
constexpr double kFar = std::numeric_limits<double>::infinity();

inline double squared_distance_to_box(const Vec3& p, const Vec3& low, const Vec3& high) {
  const auto outside = [](double v, double from, double to) {
    return std::max(std::max(from - v, v - to), 0.0);
  };
  const double x = outside(p.x, low.x, high.x);
  const double y = outside(p.y, low.y, high.y);
  const double z = outside(p.z, low.z, high.z);
  return x * x + y * y + z * z;
}

struct BoxRay {
  Vec3 origin;
  Vec3 direction;
  Vec3 inverse;  ///< 1 / direction; infinite where the direction is zero
};

/// Where the ray enters the box, or infinity. `limit` is the nearest hit so far.
double entry_into_box(const BoxRay& ray, Vec3 low, Vec3 high, double limit) {
  double near = 0.0;
  double far = limit;
  for (int axis = 0; axis < 3; ++axis) {
    if (ray.direction[axis] == 0.0) {  // 0 · infinity would be NaN
      if (ray.origin[axis] < low[axis] || ray.origin[axis] > high[axis]) {
        return kFar;
      }
      continue;
    }
    const double a = (low[axis] - ray.origin[axis]) * ray.inverse[axis];
    const double b = (high[axis] - ray.origin[axis]) * ray.inverse[axis];
    // Rounding must not cut off a hit that lies on the face of the box.
    near = std::max(near, std::min(a, b) * (1.0 - 1e-12));
    far = std::min(far, std::max(a, b) * (1.0 + 1e-12));
  }
  return near <= far ? near : kFar;
}

/// Takes in the triangles of the leaves, the nearer of two boxes first. `distance` of a node's box
/// is infinite where it is of no interest; boxes beyond `limit`, which may shrink meanwhile, are
/// left out.
template <class Node, class Distance, class TakeIn>
void search_boxes(const std::vector<Node>& nodes, const Distance& distance, const double& limit,
                  const TakeIn& take_in) {
  struct Pending {
    std::uint32_t node;
    double distance;
  };
  std::array<Pending, kStack> stack;
  std::size_t depth = 0;
  const auto wanted = [&limit](const Pending& p) {
    return p.distance != kFar && p.distance <= limit;
  };
  Pending here{0, distance(nodes[0])};
  for (;;) {
    // The limit may have shrunk since this one was put aside.
    if (wanted(here)) {
      const Node& node = nodes[here.node];
      if (node.count == 0) {
        const Pending left{node.first, distance(nodes[node.first])};
        const Pending right{node.first + 1, distance(nodes[node.first + 1])};
        const bool left_first = left.distance <= right.distance;
        const Pending& other = left_first ? right : left;
        if (wanted(other)) {
          stack[depth++] = other;
        }
        here = left_first ? left : right;
        continue;
      }
      for (std::size_t i = node.first; i < node.first + node.count; ++i) {
        take_in(i);
      }
    }
    if (depth == 0) {
      return;
    }
    here = stack[--depth];
  }
}

}  // namespace

SurfaceIndex::SurfaceIndex(const TriangleMesh& mesh) {
  const std::size_t n = mesh.triangles.size();
  if (n == 0) {
    return;
  }
  std::vector<Triangle> unordered(n);
  std::vector<Vec3> centres_m(n);
  original_.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      unordered[i][k] = mesh.vertices_m[mesh.triangles[i][k]];
    }
    centres_m[i] = (unordered[i][0] + unordered[i][1] + unordered[i][2]) / 3.0;
    original_[i] = static_cast<std::uint32_t>(i);
  }
  nodes_.reserve(2 * n);
  nodes_.emplace_back();
  split(0, 0, n, centres_m, unordered);
  corners_.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    corners_[i] = unordered[original_[i]];
  }
}

void SurfaceIndex::split(std::size_t node, std::size_t begin, std::size_t end,
                         const std::vector<Vec3>& centres_m, std::vector<Triangle>& unordered) {
  Vec3 low{kFar, kFar, kFar};
  Vec3 high = -low;
  Vec3 low_centre = low;
  Vec3 high_centre = high;
  for (std::size_t i = begin; i < end; ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      for (const Vec3& v : unordered[original_[i]]) {
        low[axis] = std::min(low[axis], v[axis]);
        high[axis] = std::max(high[axis], v[axis]);
      }
      low_centre[axis] = std::min(low_centre[axis], centres_m[original_[i]][axis]);
      high_centre[axis] = std::max(high_centre[axis], centres_m[original_[i]][axis]);
    }
  }
  nodes_[node] = {low, high, static_cast<std::uint32_t>(begin),
                  static_cast<std::uint32_t>(end - begin)};
  if (end - begin <= kLeafSize) {
    return;
  }
  const Vec3 size = high_centre - low_centre;
  const int axis = size.x >= size.y ? (size.x >= size.z ? 0 : 2) : (size.y >= size.z ? 1 : 2);
  const std::size_t middle = begin + (end - begin) / 2;
  const auto at = [&](std::size_t i) { return original_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(begin), at(middle), at(end), [&](std::uint32_t a, std::uint32_t b) {
    return std::make_pair(centres_m[a][axis], a) < std::make_pair(centres_m[b][axis], b);
  });
  const std::size_t left = nodes_.size();
  nodes_.resize(left + 2);
  nodes_[node].first = static_cast<std::uint32_t>(left);
  nodes_[node].count = 0;
  split(left, begin, middle, centres_m, unordered);
  split(left + 1, middle, end, centres_m, unordered);
}

std::optional<SurfacePoint> SurfaceIndex::nearest(Vec3 query_m, double within_m) const {
  if (nodes_.empty() || !query_m.is_finite() || !(within_m >= 0.0)) {
    return std::nullopt;
  }
  double best2 = within_m * within_m;
  std::size_t best = corners_.size();
  Vec3 best_point;
  const auto squared_distance = [&](const Node& node) {
    return squared_distance_to_box(query_m, node.low, node.high);
  };
  search_boxes(nodes_, squared_distance, best2, [&](std::size_t i) {
    const Vec3 point = nearest_on_triangle(query_m, corners_[i]);
    const double d2 = (point - query_m).squared_norm();
    const bool tie = d2 == best2 && (best == corners_.size() || original_[i] < original_[best]);
    if (d2 < best2 || tie) {
      best2 = d2, best = i, best_point = point;
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
  if (nodes_.empty() || !origin_m.is_finite() || !std::isfinite(length) || !(length > 0.0)) {
    return std::nullopt;
  }
  const Vec3 unit = direction / length;
  const BoxRay ray{origin_m, unit, {1.0 / unit.x, 1.0 / unit.y, 1.0 / unit.z}};
  double best = kFar;
  std::size_t hit = corners_.size();
  const auto entry = [&](const Node& node) {
    return entry_into_box(ray, node.low, node.high, best);
  };
  search_boxes(nodes_, entry, best, [&](std::size_t i) {
    if (const auto t = ray_meets_triangle(ray.origin, ray.direction, corners_[i]);
        t && (*t < best || (*t == best && original_[i] < original_[hit]))) {
      best = *t, hit = i;
    }
  });
  if (hit == corners_.size()) {
    return std::nullopt;
  }
  return RayHit{origin_m + best * unit, triangle_normal(corners_[hit]), best, original_[hit]};
}

bool SurfaceIndex::contains(Vec3 query_m) const {
  // Seen from inside, the first face along any ray shows its back. Three rays outvote one that
  // grazes an edge.
  constexpr std::array<Vec3, 3> kDirections = {
      {{0.8164, 0.3147, 0.4842}, {-0.2741, 0.9013, -0.3353}, {0.1372, -0.5329, -0.8350}}};
  int inside = 0;
  for (const Vec3& direction : kDirections) {
    if (const auto hit = first_hit(query_m, direction); hit && hit->normal.dot(direction) > 0.0) {
      ++inside;
    }
  }
  return inside >= 2;
}

}  // namespace orthonav::nav
