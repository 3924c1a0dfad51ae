#pragma once

#include <cstdint>
#include <optional>

#include "nav/geometry/mesh.h"
#include "nav/guidance/screw.h"

namespace orthonav::nav {

/// Where a surgeon moves or tilts a screw to, at right angles to its axis
/// (nav/guidance/anatomical_deviation.h).
enum class ScrewDirection : std::uint8_t { kCranial, kCaudal, kMedial, kLateral };

/// What of it is moved.
enum class ScrewPart : std::uint8_t {
  kWhole,   ///< entry and target alike
  kEntry,   ///< the axis goes on through where the target was
  kTarget,  ///< the entry stays
};

// Each gives the screw anew: side, radius and length stay as they are, and so does the reason for a
// breach. None where its directions have no names (`directions_of`).

/// Moved by so much across its axis. The new axis meets the bone from behind in the new entry, on
/// the part that a pointer reaches; None too where it does not meet it there, within 25 mm of
/// abreast the old entry, or goes through other bone before. `kTarget` asks nothing of the bone.
[[nodiscard]] std::optional<ScrewPlan> moved_screw(const ScrewPlan& screw, ScrewPart part,
                                                   ScrewDirection direction, double by_m,
                                                   const SurfaceIndex& bone,
                                                   const SurfaceIndex& reachable);

/// Turned about its entry, so that it aims more that way.
[[nodiscard]] std::optional<ScrewPlan> tilted_screw(const ScrewPlan& screw,
                                                    ScrewDirection direction, double by_rad);

/// Another size: entry and axis stay. A radius of 0 and a length of 0 leave what there is.
[[nodiscard]] ScrewPlan resized_screw(const ScrewPlan& screw, double radius_m, double length_m);

/// From the entry to the target.
[[nodiscard]] double screw_length_m(const ScrewPlan& screw);

/// A screw against how it was planned before, in the directions of the earlier plan.
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

  /// How far the entry moved in space.
  [[nodiscard]] double entry_moved_m() const;
  friend bool operator==(const ScrewDifference&, const ScrewDifference&) = default;
};
/// Where directions have no names (`directions_of`), entry and aim stay zero; sizes are told.
[[nodiscard]] ScrewDifference difference_of(const ScrewPlan& before, const ScrewPlan& now);
/// Between both axes.
[[nodiscard]] double tilt_between_rad(const ScrewPlan& before, const ScrewPlan& now);

}  // namespace orthonav::nav
