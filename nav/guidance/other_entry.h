#pragma once

#include <optional>

#include "nav/guidance/screw_clearance.h"

namespace orthonav::nav {

/// Where another entry is looked for.
struct OtherEntryRules {
  double from_hole_m = 0.0032;  ///< at least so far from the middle of the hole that was made
  double within_m = 0.008;      ///< of the planned axis
  double steepest_rad = kSteepestEntry_rad;  ///< slope of the bone against the new axis
};

struct OtherEntry {
  Point<Vertebra> entry;  ///< on the bone's surface
  Clearance clearance;    ///< of the screw from there to the planned target
  double from_hole_m = 0.0;
};

/// Where else on the bone a screw may enter on its way to its target, with the largest clearance to
/// the cortex: over a grid of 1 mm, then of 0.2 mm about the best. None where no such screw stays
/// inside of the bone, and where the plan states no radius. Takes a few hundred clearances.
[[nodiscard]] std::optional<OtherEntry> other_entry(const ScrewPlan& plan, Point<Vertebra> hole,
                                                    const SurfaceIndex& bone,
                                                    const OtherEntryRules& rules = {});

}  // namespace orthonav::nav
