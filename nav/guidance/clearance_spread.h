#pragma once

#include <array>
#include <optional>

#include "base/tracked.h"
#include "nav/guidance/screw_clearance.h"
#include "nav/registration/tre.h"

namespace orthonav::nav {

/// A screw's clearance, given the uncertainty of its pose.
struct ClearanceSpread {
  double lower_95_m = 0.0;  ///< with 95 % probability the clearance is above it
  std::array<double, kPedicleGrades> grade_probability{};  ///< A to E; they add up to 1
  /// The probability of that grade alone.
  [[nodiscard]] double probability(PedicleGrade grade) const {
    return grade_probability[static_cast<std::size_t>(grade)];
  }
};

/// `clearance` is that of the screw at its assumed pose. The true pose relative to the bone differs
/// from it by a normally distributed motion (t, w) about a centre c with the covariance of `pose`.
///
/// Method: the depth of a place p on the screw, to first order d + n·(t + w × (p - c)) with n the
/// direction in which the depth grows, is linear in the motion. The clearance is the least depth
/// over some 180 places all over the screw, so another wall may become the nearest. A single normal
/// distribution about the nearest place would miss that and be too optimistic in a narrow pedicle
/// (two equally near walls cost another 0.3 SD). The distribution of the least depth is taken over
/// 1024 motions, the same for every screw and frame, so that figures of similar screws differ only
/// by the screws and don't flicker: quasi-random points in six dimensions (Roberts 2018, the
/// additive recurrence R6), made normal. Deterministic; allocates nothing.
///
/// It neglects that walls are curved (the ring of places around the screw makes up for most of
/// that; with motions of 3 mm the bound is off by some tenths of a millimetre), and anything that
/// is not in the covariance. Empty if the covariance is not finite, or if `least_clearance` is
/// empty for the screw.
[[nodiscard]] std::optional<ClearanceSpread> clearance_spread(const SurfaceIndex& bone,
                                                              const ScrewCylinder& screw,
                                                              const Clearance& clearance,
                                                              const PoseUncertainty& pose);

/// The uncertainty of a tracked tool's pose relative to the bone, from the uncertainties of both
/// poses. They are taken as independent: errors that strokes and tool share (the cameras, the map)
/// must not be in `bone`, or they are counted although they cancel. `origin_in_vertebra` is the
/// origin of the tracked marker, about which the rotations in its covariance (World's axes) are
/// taken.
[[nodiscard]] PoseUncertainty with_tool(const PoseUncertainty& bone,
                                        const Transform<Vertebra, World>& vertebra_from_world,
                                        Point<Vertebra> origin_in_vertebra,
                                        const PoseCovariance& tool_in_world);

/// A screw's clearance, and its spread if the uncertainty of the pose is known.
struct ScrewClearance {
  Clearance least;
  std::optional<ClearanceSpread> spread;
};

/// The clearance of a screw, with its spread unless `pose` is null.
[[nodiscard]] std::optional<ScrewClearance> screw_clearance(const SurfaceIndex& bone,
                                                            const ScrewCylinder& screw,
                                                            const PoseUncertainty* pose);

}  // namespace orthonav::nav
