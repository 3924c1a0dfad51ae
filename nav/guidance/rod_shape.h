#pragma once

#include <span>
#include <vector>

#include "base/vec.h"

namespace orthonav::nav {

/// A bend in the rod: a circular arc of length `width_m` of its axis. `roll_rad` says to which side
/// the far end is bent: 0 towards the line drawn along the rod, positive by the right-hand rule
/// about the direction from its first to its last end.
struct RodArc {
  double centre_m = 0.0;  ///< along the axis from the first end
  double width_m = 0.0;
  double angle_rad = 0.0;
  double roll_rad = 0.0;
};

/// A straight stretch between bends; `begin_m` and `end_m` along the axis from the first end.
struct RodStraight {
  Vec3 from_m;
  Vec3 direction;
  double begin_m = 0.0;
  double end_m = 0.0;
};

/// A place on the axis, with the frame that the rod carries along it without twist.
struct RodPlace {
  Vec3 at_m;
  Vec3 line{1.0, 0.0, 0.0};    ///< towards the drawn line
  Vec3 beside{0.0, 1.0, 0.0};  ///< a quarter turn from it, positive about `along`
  Vec3 along{0.0, 0.0, 1.0};   ///< towards the last end
};

// The rod's own frame: origin at its first end, z along its first straight towards the last end, x
// towards the drawn line.

/// The straights of a bent rod, one more than its bends. A bender does not twist: the drawn line
/// does not turn about the axis, and the axis keeps its length. The arcs must be in order and must
/// not overlap.
[[nodiscard]] std::vector<RodStraight> rod_straights(std::span<const RodArc> arcs, double length_m);

/// The place on the axis `at_m` from the first end.
[[nodiscard]] RodPlace rod_place(std::span<const RodArc> arcs, double at_m);

/// The axis as a chain of chords from the first end to the last, eight per arc: less than 0.03 mm
/// off an arc of 20 mm length and 27 mm radius.
[[nodiscard]] std::vector<Vec3> rod_axis(std::span<const RodArc> arcs, double length_m);

}  // namespace orthonav::nav
