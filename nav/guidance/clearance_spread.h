#pragma once

#include <array>
#include <optional>

#include "base/tracked.h"
#include "nav/guidance/screw_clearance.h"
#include "nav/registration/tre.h"

namespace orthonav::nav {

/// What the uncertainty of a screw's pose leaves of its clearance.
struct ClearanceSpread {
  double lower_95_m = 0.0;  ///< with 95 % probability the clearance is above it
  std::array<double, kPedicleGrades> grade_probability{};  ///< A to E; they add up to 1
  /// Of that grade alone.
  [[nodiscard]] double probability(PedicleGrade grade) const {
    return grade_probability[static_cast<std::size_t>(grade)];
  }
};

/// `clearance` is that of the screw where it is taken to be. Its pose relative to the bone is off
/// by a normally distributed motion (t, w) about a centre c with the covariance of `pose`.
///
/// How: the depth of a place p of the screw, d + n·(t + w × (p - c)) to first order, n being the
/// direction in which it grows, is linear in the motion; the clearance is the least of them over
/// some 180 places all over the screw, so that another wall may become the nearest, which one
/// normal distribution about the binding place would miss (it is too hopeful in a narrow pedicle:
/// two walls alike cost another 0.3 SD). The distribution of that least is taken over 1024 motions,
/// the same for every screw and frame, so that figures of like screws differ by the screws alone
/// and don't flicker: quasi-random points in six dimensions (Roberts 2018, the additive recurrence
/// R6), made normal. Deterministic; allocates nothing.
///
/// What it leaves out: that walls are curved (the rim of places about the screw makes up for most
/// of it; with motions of 3 mm the bound is off by some tenths of a millimetre), and whatever is
/// not in the covariance.
/// None when the covariance is not finite, or `least_clearance` gave none for the screw.
[[nodiscard]] std::optional<ClearanceSpread> clearance_spread(const SurfaceIndex& bone,
                                                              const ScrewCylinder& screw,
                                                              const Clearance& clearance,
                                                              const PoseUncertainty& pose);

/// The bone's pose and a tracked tool's together, as the uncertainty of the tool's pose relative to
/// the bone. Both are taken as independent: what strokes and tool share (the cameras, the map) is
/// counted twice, on the safe side. `origin_in_vertebra` is that of the tracked marker, about which
/// its covariance (World's axes) turns.
[[nodiscard]] PoseUncertainty with_tool(const PoseUncertainty& bone,
                                        const Transform<Vertebra, World>& vertebra_from_world,
                                        Point<Vertebra> origin_in_vertebra,
                                        const PoseCovariance& tool_in_world);

/// A screw's clearance, and what its pose leaves open of it where that is known.
struct ScrewClearance {
  Clearance least;
  std::optional<ClearanceSpread> spread;
};

/// Of a screw, with both where there are both. `pose` may be null.
[[nodiscard]] std::optional<ScrewClearance> screw_clearance(const SurfaceIndex& bone,
                                                            const ScrewCylinder& screw,
                                                            const PoseUncertainty* pose);

}  // namespace orthonav::nav
