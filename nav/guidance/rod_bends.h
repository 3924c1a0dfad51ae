#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/result.h"
#include "base/vec.h"
#include "nav/guidance/rod_bend_fit.h"
#include "nav/guidance/rod_bender.h"
#include "nav/guidance/rod_cut.h"

namespace orthonav::nav {

/// The bender and rod, and how near the rod has to come to the seats.
struct RodBending {
  RodBender bender;
  RodMaterial material;
  double diameter_m = 0.0055;
  double overhang_m = RodSeating{}.overhang_m;
  /// Length of the rod that a tulip holds, where the rod is straight. Estimate: tulips are 8 mm or
  /// longer.
  double tulip_m = 0.010;
  /// Largest distance from the seats to the rod's axis if the instructions are followed.
  double tolerance_m = 0.0003;
  /// How far a bend may reach into a tulip. At its edge the rod is then 0.07 mm off straight at the
  /// tightest radius, 31 mm after spring-back: less than the play of a rod in a tulip. Estimate.
  double reach_m = 0.002;
};

/// One bend to be made: by `arc.angle_rad`, for which the bender is set to `set_rad`.
struct RodInstruction {
  RodArc arc;
  double set_rad = 0.0;
  std::size_t gap = 0;  ///< between this seat and the next, from 0
  Vec3 middle_m;        ///< of the bend on the finished rod, in the frame of the seats
};

/// How a straight rod becomes the one of the seats: cut to `fit.length_m`, a line drawn along it,
/// bent at each place in order from the first end. The first bend goes towards the line: roll 0.
struct RodInstructions {
  std::vector<Vec3> seats_m;
  std::vector<RodInstruction> bends;
  double reach_m = 0.0;  ///< of its bends into the tulips, at most
  RodFit fit;            ///< the finished rod, and the seats on it

  [[nodiscard]] double cut_length_m() const { return fit.length_m; }
};

/// Limits of what `rod_instructions` takes.
inline constexpr double kWidestTulip_m = 0.03;
inline constexpr double kFinestTolerance_m = 0.00005;
inline constexpr double kCoarsestTolerance_m = 0.005;

/// Instructions for a rod through these seats, in order along it (RodCut::seats_m). Bends go only
/// into the gaps between tulips, at most one per gap, and reach into the tulips by `reach_m` at
/// most; there are as few as keep every seat within `tolerance_m`, and among those choices the
/// gentlest. Each bend is made once, from the first end to the last, and none is bent back.
/// Refuses, in one line: values outside their limits, fewer than two seats, seats that are not
/// finite or meet, and seats that this bender can't reach because a radius would be too tight or a
/// gap is too short.
Result<RodInstructions> rod_instructions(std::span<const Vec3> seats_m, const RodBending& bending);

}  // namespace orthonav::nav
