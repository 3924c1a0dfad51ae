#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"

namespace orthonav::nav {

/// A bounding volume hierarchy of triangles with eight children per node, as many as a few vector
/// instructions test at once (Wald, Benthin & Boulos 2008, "Getting rid of packets"). Boxes are
/// rounded outwards to single precision, so that a search by them misses no triangle.
class BoxTree {
 public:
  static constexpr std::size_t kWide = 8;
  /// Marks the child that is a triangle.
  static constexpr std::uint32_t kTriangle = 0x8000'0000U;
  /// The most boxes put aside: seven at each of the eleven levels that 2^31 triangles need at most.
  static constexpr std::size_t kDeepest = 88;

  using Lanes = std::array<float, kWide>;
  struct alignas(32) Node {
    std::array<Lanes, 3> centre{};             ///< by axis, metres
    std::array<Lanes, 3> half{};               ///< of the box's size
    std::array<std::uint32_t, kWide> child{};  ///< a node, or a triangle's place with its mark
    std::uint32_t count = 0;                   ///< of children; the first ones are used
  };

  BoxTree() = default;
  /// `order` becomes the triangles' order in the tree. At most 2^31 - 1.
  BoxTree(std::span<const std::array<Vec3, 3>> triangles, std::vector<std::uint32_t>& order);

  [[nodiscard]] bool empty() const { return nodes_.empty(); }
  /// The first is the root.
  [[nodiscard]] std::span<const Node> nodes() const { return nodes_; }
  /// The largest coordinate of any corner, metres.
  [[nodiscard]] double farthest_m() const { return farthest_m_; }

 private:
  std::vector<Node> nodes_;
  double farthest_m_ = 0.0;
};

/// Which of a node's boxes are no farther than the limit, one bit per box. All are compared before
/// any is examined: a branch for each would be mispredicted too often.
template <class Key>
[[nodiscard]] std::uint32_t boxes_within(const Key& limit, const BoxTree::Node& node,
                                         const std::array<Key, BoxTree::kWide>& keys) {
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < BoxTree::kWide; ++i) {
    bits |= static_cast<std::uint32_t>(keys[i] <= limit) << i;
  }
  return bits & ((1U << node.count) - 1U);
}

/// Calls `take_in` for the triangles whose boxes are no farther than `limit`, nearest boxes first;
/// `take_in` may lower `limit`. `keys` computes how far the boxes of a node are.
template <class Key, class Keys, class TakeIn>
void search_boxes(std::span<const BoxTree::Node> nodes, const Keys& keys, const Key& limit,
                  const TakeIn& take_in) {
  struct Pending {
    Key key;
    std::uint32_t child;
  };
  std::array<Pending, BoxTree::kDeepest> stack;
  std::size_t depth = 0;
  std::uint32_t here = 0;
  for (;;) {
    const BoxTree::Node& node = nodes[here];
    std::array<Key, BoxTree::kWide> key;
    keys(node, key);
    const std::size_t others = depth;
    for (auto left = boxes_within(limit, node, key); left != 0; left &= left - 1U) {
      const auto i = static_cast<std::size_t>(std::countr_zero(left));
      std::size_t at = depth++;
      for (; at > others && stack[at - 1].key < key[i]; --at) {
        stack[at] = stack[at - 1];
      }
      stack[at] = {key[i], node.child[i]};
    }
    // The limit may have shrunk since these were put aside.
    for (;;) {
      if (depth == 0) {
        return;
      }
      const Pending next = stack[--depth];
      if (!(next.key <= limit)) {
        continue;
      }
      if ((next.child & BoxTree::kTriangle) == 0) {
        here = next.child;
        break;
      }
      take_in(next.child & ~BoxTree::kTriangle);
    }
  }
}

}  // namespace orthonav::nav
