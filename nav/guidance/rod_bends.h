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

/// With what a rod is bent, and how near it has to come.
struct RodBending {
  RodBender bender;
  RodMaterial material;
  double diameter_m = 0.0055;
  double overhang_m = RodSeating{}.overhang_m;
  /// Of the rod that a tulip holds; there it is straight. Estimate: a tulip is 8 mm and more.
  double tulip_m = 0.010;
  /// From the seats to the axis of the rod that the instructions promise.
  double tolerance_m = 0.0003;
};

/// One bend to be made: by `arc.angle_rad`, for which the bender is set to `set_rad`.
struct RodInstruction {
  RodArc arc;
  double set_rad = 0.0;
  std::size_t gap = 0;  ///< between this seat and the next, from 0
};

/// How a straight rod becomes the one of the seats: cut to `fit.length_m`, a line drawn along it,
/// bent at each place in order from the first end. The first bend goes towards the line: roll 0.
struct RodInstructions {
  std::vector<Vec3> seats_m;
  std::vector<RodInstruction> bends;  ///< `made` of them as they were measured, the rest to be made
  std::size_t made = 0;
  RodFit fit;  ///< the rod when all has been followed, and the seats on it

  [[nodiscard]] double cut_length_m() const { return fit.length_m; }
};

/// Limits of what `rod_instructions` takes.
inline constexpr double kWidestTulip_m = 0.03;
inline constexpr double kFinestTolerance_m = 0.00005;
inline constexpr double kCoarsestTolerance_m = 0.005;

/// Instructions for a rod through these seats, in order along it (RodCut::seats_m). A bend goes
/// into the gaps between tulips alone, never into a tulip, one into each gap at most; as few as
/// keep every seat within `tolerance_m`, and among those the gentlest. Each is made once, from the
/// first end to the last, and none is bent back. Refuses, in one line: values outside their limits,
/// fewer than two seats, seats that are not finite or meet, and seats that this bender can't reach
/// because a radius would be too tight or a gap is too short.
Result<RodInstructions> rod_instructions(std::span<const Vec3> seats_m, const RodBending& bending);

/// The same when the first bends are made, as `made` tells from measuring them (rod_stroke.h): the
/// bends still to come make up for what those are off, as well as they can. Refuses more bends made
/// than were planned and what is not finite, what `rod_instructions` refuses of `bending`, and a
/// rod that can't be brought nearer than `kLost_m` to a seat: another one has to be begun.
Result<RodInstructions> rod_instructions_after(const RodInstructions& plan,
                                               std::span<const RodArc> made,
                                               const RodBending& bending);

/// Half of the 5 mm by which a rod must not be forced down into a tulip (Paik et al. 2013, Spine J
/// 13:1617).
inline constexpr double kLost_m = 0.0025;

}  // namespace orthonav::nav
