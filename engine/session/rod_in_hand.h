#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "base/angle.h"
#include "base/time.h"
#include "base/transform.h"
#include "nav/guidance/rod_bends.h"
#include "nav/guidance/rod_stroke.h"

namespace orthonav::engine {

/// How a rod is measured while it is bent, and how long it is shown.
struct RodInHandRules {
  nav::RodStrokeRules stroke;
  /// A bend found farther from its instruction than this many of the SDs above was not made as a
  /// hand errs, but wrongly. It is measured with four times those SDs.
  double surprise_sds = 1.5;
  /// The most that a stroke may lie on one side (nav::MeasuredBend): two passes a third of a turn
  /// apart reach 0.5, a single one 0.9.
  double most_one_sided = 0.75;
  /// The rod has no tag: nobody knows how long it lies where it was stroked. It is drawn there for
  /// this time after the last point. Estimate.
  Duration shown_for = std::chrono::seconds(30);

  /// Every problem at once; empty when all is well.
  [[nodiscard]] std::vector<std::string> check() const;
};

/// The bend that is to be made next.
struct NextBend {
  std::size_t number = 1;  ///< from 1
  double at_m = 0.0;       ///< its middle, along the axis from the first end
  double roll_rad = 0.0;
  double set_rad = 0.0;  ///< on the bender
};

/// One bend as measured on the rod in hand.
struct RodBendInHand {
  nav::MeasuredBend found;
  nav::RodInstructions planned;  ///< by which it was made
};

/// A place on the rod where something is to be done.
struct RodMark {
  Point<World> at;
  Vec3 along;  ///< unit, the rod's direction there in World
};

/// The rod in hand as it lay when it was stroked.
struct LyingRod {
  std::vector<Point<World>> axis;  ///< from the first end to the last
  double diameter_m = 0.0;
  std::optional<RodMark> cut;  ///< absent: it is cut
  double cut_length_m = 0.0;
  std::optional<NextBend> next;  ///< absent: all bends are made
  RodMark bend;                  ///< its middle; of no meaning without `next`
  /// Unit, in World: to where its far end goes. Absent for the first bend, which goes to the drawn
  /// line, and that can't be felt.
  std::optional<Vec3> towards;
  Timestamp shown_until{};
};

/// The first `count` bends of the instructions, of which there are as many at least.
[[nodiscard]] std::vector<nav::RodArc> first_bends(const nav::RodInstructions& instructions,
                                                   std::size_t count);

/// The first bend that is not made; none if all are.
[[nodiscard]] std::optional<NextBend> next_bend_of(const nav::RodInstructions& instructions);

/// Where the rod lies and what is to be done with it. `world_from_rod` and `rod_in_world` are its
/// frame in World (nav/guidance/rod_shape.h); `length_m` is more than instructed if it is not cut.
[[nodiscard]] LyingRod lying_rod(const nav::RodInstructions& instructions,
                                 const Mat3& world_from_rod, Vec3 rod_in_world, double length_m);

}  // namespace orthonav::engine
