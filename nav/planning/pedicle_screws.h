#pragma once

#include <array>
#include <span>

#include "base/result.h"
#include "nav/planning/pedicle_axis.h"

namespace orthonav::nav {

/// An available screw size.
struct ImplantSize {
  double diameter_m = 0.0;
  double length_m = 0.0;
};

/// How pedicle screws are planned.
struct PlanningRules {
  /// Of the sizes that leave at least this clearance to the cortex, the thickest is taken; if none
  /// does, the thinnest, provided it stays inside.
  double wanted_clearance_m = 0.001;
  double thickest_m = 0.0065;                ///< no thicker screw is taken
  double steepest_rad = kSteepestEntry_rad;  ///< largest slope of the bone at the entry, relative
                                             ///< to the axis
};

/// A planned pedicle screw with its quality figures.
struct PlannedScrew {
  ScrewPlan plan;
  Clearance clearance;
  double room_m = 0.0;           ///< diameter of the thickest cylinder that fits about the axis
  double convergence_rad = 0.0;  ///< from the vertebra's sagittal plane, towards the midline
  double cranial_rad = 0.0;      ///< from the plane across its canal, towards the head
  double before_front_m = 0.0;   ///< from the tip to the far cortex along the axis
};

/// One per side, left first: the screw, or why there is none, such as "pedicle too narrow: ...".
struct PedicleScrews {
  CanalFrame canal;
  std::array<Result<PlannedScrew>, 2> sides;
};

/// Pedicle screws from the surface of a vertebra alone: for each side the axis with the largest
/// clearance to the cortex, over the place (two), the direction (two) and the depth (one degree of
/// freedom); the depth is the longest listed length that ends safely before the far cortex. Both
/// sides get the same size, and among screws with nearly the same clearance those that mirror each
/// other. Clearance is that of `least_clearance`. Fails if no canal is found (`find_canal`) or the
/// list of sizes is empty. Deterministic.
Result<PedicleScrews> plan_pedicle_screws(const TriangleMesh& mesh, const SurfaceIndex& bone,
                                          std::span<const ImplantSize> sizes,
                                          const PlanningRules& rules = {});

}  // namespace orthonav::nav
