#pragma once

#include <cstdint>
#include <optional>

#include "nav/geometry/mesh.h"
#include "nav/guidance/screw.h"

namespace orthonav::nav {

/// Where a surgeon moves or tilts a screw to, at right angles to its axis
/// (nav/guidance/anatomical_deviation.h).
enum class ScrewDirection : std::uint8_t { kCranial, kCaudal, kMedial, kLateral };

/// Which part of the screw is moved.
enum class ScrewPart : std::uint8_t {
  kWhole,   ///< entry and target alike
  kEntry,   ///< the axis still runs through the old target
  kTarget,  ///< the entry stays
};

// Each returns a changed copy of the screw: side, radius, length and the reason for a breach stay
// as they are, except where stated. Empty if its directions have no names (`directions_of`).

/// Moved by this much across its axis. The new entry is where the new axis meets the bone from
/// behind, on the part that a pointer reaches. Also empty if the axis does not meet the bone there
/// within 25 mm, along it, of the old entry, or passes through other bone first. `kTarget` does not
/// use the bone.
[[nodiscard]] std::optional<ScrewPlan> moved_screw(const ScrewPlan& screw, ScrewPart part,
                                                   ScrewDirection direction, double by_m,
                                                   const SurfaceIndex& bone,
                                                   const SurfaceIndex& reachable);

/// The same by any vector.
[[nodiscard]] std::optional<ScrewPlan> shifted_screw(const ScrewPlan& screw, ScrewPart part,
                                                     Vec3 by_m, const SurfaceIndex& bone,
                                                     const SurfaceIndex& reachable);

/// Turned about its entry so that it aims more in that direction.
[[nodiscard]] std::optional<ScrewPlan> tilted_screw(const ScrewPlan& screw,
                                                    ScrewDirection direction, double by_rad);

/// Another size: entry and axis stay. A radius or length of 0 leaves the old one.
[[nodiscard]] ScrewPlan resized_screw(const ScrewPlan& screw, double radius_m, double length_m);

/// From the entry to the target.
[[nodiscard]] double screw_length_m(const ScrewPlan& screw);

/// A screw compared with its earlier plan, in the directions of that plan.
struct ScrewDifference {
  double entry_cranial_m = 0.0;
  double entry_medial_m = 0.0;
  double entry_inward_m = 0.0;  ///< along the earlier axis
  double aim_cranial_rad = 0.0;
  double aim_medial_rad = 0.0;
  double diameter_from_m = 0.0;  ///< 0: not stated
  double diameter_to_m = 0.0;
  double length_from_m = 0.0;
  double length_to_m = 0.0;

  friend bool operator==(const ScrewDifference&, const ScrewDifference&) = default;
};
/// If directions have no names (`directions_of`), entry and aim stay zero; sizes are given.
[[nodiscard]] ScrewDifference difference_of(const ScrewPlan& before, const ScrewPlan& now);
/// The angle between both axes.
[[nodiscard]] double tilt_between_rad(const ScrewPlan& before, const ScrewPlan& now);

}  // namespace orthonav::nav
