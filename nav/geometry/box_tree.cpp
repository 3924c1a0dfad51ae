#include "nav/geometry/box_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace orthonav::nav {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

struct Range {
  std::size_t begin;
  std::size_t end;
  [[nodiscard]] std::size_t size() const { return end - begin; }
};

struct Box {
  Vec3 low{kFar, kFar, kFar};
  Vec3 high{-kFar, -kFar, -kFar};

  void take_in(const Box& other) {
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], other.low[axis]);
      high[axis] = std::max(high[axis], other.high[axis]);
    }
  }
};

Box box_of(const std::array<Vec3, 3>& triangle) {
  Box box;
  for (const Vec3& v : triangle) {
    box.take_in({v, v});
  }
  return box;
}

/// Stores the box in single precision, rounded outwards so that it does not shrink.
void put(const Box& box, std::size_t lane, BoxTree::Node& node) {
  constexpr double kLargest = std::numeric_limits<float>::max();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double low = box.low[static_cast<int>(axis)];
    const double high = box.high[static_cast<int>(axis)];
    const auto centre = static_cast<float>(std::clamp(0.5 * (low + high), -kLargest, kLargest));
    const double half = std::max(high - centre, centre - low);
    node.centre[axis][lane] = centre;
    node.half[axis][lane] = std::nextafter(static_cast<float>(std::min(half, kLargest)),
                                           std::numeric_limits<float>::infinity());
  }
}

class Builder {
 public:
  Builder(std::span<const std::array<Vec3, 3>> triangles, std::vector<std::uint32_t>& order)
      : triangles_(triangles), order_(order) {
    order_.resize(triangles.size());
    std::iota(order_.begin(), order_.end(), 0U);
    centres_m_.reserve(triangles.size());
    for (const auto& t : triangles) {
      centres_m_.push_back((t[0] + t[1] + t[2]) / 3.0);
    }
  }

  /// Appends the node of this range and all below it; returns the box around it.
  Box add(Range range) {
    const std::size_t here = nodes.size();
    nodes.emplace_back();
    Box whole;
    for (const Range part : parts_of(range)) {
      const auto below = static_cast<std::uint32_t>(nodes.size());
      const bool single = part.size() == 1;
      const Box box = single ? box_of(triangles_[order_[part.begin]]) : add(part);
      BoxTree::Node& node = nodes[here];
      const std::size_t lane = node.count++;
      node.child[lane] =
          single ? static_cast<std::uint32_t>(part.begin) | BoxTree::kTriangle : below;
      put(box, lane, node);
      whole.take_in(box);
    }
    return whole;
  }

  std::vector<BoxTree::Node> nodes;

 private:
  /// As few parts as possible while the tree stays as shallow as this many triangles allow.
  std::vector<Range> parts_of(Range range) {
    std::size_t largest = 1;
    while (largest * BoxTree::kWide < range.size()) {
      largest *= BoxTree::kWide;
    }
    std::vector<Range> parts;
    divide(range, (range.size() + largest - 1) / largest, parts);
    return parts;
  }

  /// Divides the range into parts with equally many triangles.
  void divide(Range range, std::size_t count, std::vector<Range>& parts) {
    if (count == 1) {
      parts.push_back(range);
      return;
    }
    const std::size_t first = count / 2;
    const std::size_t middle = range.begin + range.size() * first / count;
    separate(range, middle);
    divide({range.begin, middle}, first, parts);
    divide({middle, range.end}, count - first, parts);
  }

  /// Separates them along the axis on which their centres are spread most.
  void separate(Range range, std::size_t middle) {
    Vec3 low = centres_m_[order_[range.begin]];
    Vec3 high = low;
    for (std::size_t i = range.begin; i < range.end; ++i) {
      for (int axis = 0; axis < 3; ++axis) {
        low[axis] = std::min(low[axis], centres_m_[order_[i]][axis]);
        high[axis] = std::max(high[axis], centres_m_[order_[i]][axis]);
      }
    }
    const Vec3 size = high - low;
    const int axis = size.x >= size.y ? (size.x >= size.z ? 0 : 2) : (size.y >= size.z ? 1 : 2);
    const auto at = [&](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(range.begin), at(middle), at(range.end),
                     [&](std::uint32_t a, std::uint32_t b) {
                       return std::pair(centres_m_[a][axis], a) < std::pair(centres_m_[b][axis], b);
                     });
  }

  std::span<const std::array<Vec3, 3>> triangles_;
  std::vector<std::uint32_t>& order_;
  std::vector<Vec3> centres_m_;
};

}  // namespace

BoxTree::BoxTree(std::span<const std::array<Vec3, 3>> triangles,
                 std::vector<std::uint32_t>& order) {
  Builder builder(triangles, order);
  if (triangles.empty()) {
    return;
  }
  static_cast<void>(builder.add({0, triangles.size()}));
  nodes_ = std::move(builder.nodes);
  for (const auto& t : triangles) {
    for (const Vec3& v : t) {
      farthest_m_ = std::max({farthest_m_, std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    }
  }
}

}  // namespace orthonav::nav
