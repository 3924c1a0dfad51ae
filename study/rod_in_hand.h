#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/random.h"
#include "base/vec.h"

namespace orthonav::engine {

/// The smallest turn that takes direction `from` to `to`, as a rotation vector.
[[nodiscard]] Vec3 rod_rotation_rad(Vec3 from, Vec3 to);

/// How a rod lies in the heads.
struct RodLie {
  double mean_m = 0.0;     ///< distance of the seats from the rod's axis
  double largest_m = 0.0;  ///< of one seat
  double span_m = 0.0;     ///< along the rod from the first seat's foot to the last one's
};

struct RodCorrection {
  std::size_t joint = 0;
  Vec3 rotation_rad;
};

/// A rod while it is bent: straight between its bends, which are as many as the inner heads.
class RodInHand {
 public:
  /// Not bent yet; its places are as far apart as the seats. It begins at the first seat and points
  /// to the second. Needs at least two.
  static RodInHand straight(std::span<const Vec3> seats_m);

  /// A given shape: straight from each of these places to the next. Needs at least two.
  static RodInHand along(std::vector<Vec3> places_m);

  [[nodiscard]] const std::vector<Vec3>& places_m() const { return places_m_; }
  /// From a place to the next.
  [[nodiscard]] Vec3 chord_m(std::size_t i) const { return places_m_[i + 1] - places_m_[i]; }
  /// Moves all beyond place `i` along the rod.
  void lengthen(std::size_t i, double by_m);
  /// Turns all beyond the joint about it. A rod is not twisted by a bender: that part of the turn
  /// which goes about the rod itself is left out.
  void bend(std::size_t joint, Vec3 rotation_rad);
  /// Moves the rod as a whole to where its axis, prolonged at both ends, lies nearest to the seats
  /// (least squares, closest points).
  RodLie lay_on(std::span<const Vec3> seats_m);
  /// The worst bend of the rod as it lies now, and its error. Needs at least three seats.
  [[nodiscard]] RodCorrection worst_bend(std::span<const Vec3> seats_m) const;
  /// The same for a rod whose places do not correspond to the seats: at the place nearest to the
  /// seat where the rod's turn is most wrong.
  [[nodiscard]] RodCorrection worst_bend_near(std::span<const Vec3> seats_m) const;

 private:
  std::vector<Vec3> places_m_;
};

/// Heads of one side of a lumbar spine, from below: 3 to 6, on a lordotic curve.
[[nodiscard]] std::vector<Vec3> drawn_lumbar_heads_m(Random& random);

/// For every head the direction nearest to `to_bone` that is square to the rod there, or zero where
/// the rod runs along `to_bone`.
[[nodiscard]] std::vector<Vec3> rod_screw_directions(std::span<const Vec3> heads_m, Vec3 to_bone);

}  // namespace orthonav::engine
