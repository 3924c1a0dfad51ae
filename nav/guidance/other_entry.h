#pragma once

#include <optional>

#include "nav/guidance/screw_clearance.h"

namespace orthonav::nav {

/// Where another entry is looked for.
struct OtherEntryRules {
  double from_hole_m = 0.0032;  ///< at least this far from the middle of the existing hole
  double within_m = 0.008;      ///< at most this far from the planned axis
  double steepest_rad = kSteepestEntry_rad;  ///< largest slope of the bone relative to the new axis
};

struct OtherEntry {
  Point<Vertebra> entry;  ///< on the bone's surface
  Clearance clearance;    ///< of the screw from there to the planned target
  double from_hole_m = 0.0;
};

/// Where else on the bone a screw may enter to reach its target, with the largest clearance to the
/// cortex: over a grid of 1 mm, then of 0.2 mm about the best. Empty if no such screw stays inside
/// the bone, or if the plan states no radius. Computes a few hundred clearances.
[[nodiscard]] std::optional<OtherEntry> other_entry(const ScrewPlan& plan, Point<Vertebra> hole,
                                                    const SurfaceIndex& bone,
                                                    const OtherEntryRules& rules = {});

}  // namespace orthonav::nav
