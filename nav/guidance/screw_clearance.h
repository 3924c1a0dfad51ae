#pragma once

#include <array>
#include <optional>
#include <span>

#include "nav/guidance/screw_cylinder.h"

namespace orthonav::nav {

/// How far a screw breaks through the cortex, by the revised Gertzbein-Robbins scale: A not at all,
/// B less than 2 mm, C 2 to less than 4, D 4 to less than 6, E 6 mm and more. (Gertzbein and
/// Robbins 1990, "Accuracy of pedicular screw placement in vivo", Spine 15(1):11-14, had 0, up to
/// 2, 2 to 4 and more than 4 mm.)
enum class PedicleGrade { kA, kB, kC, kD, kE };
inline constexpr std::size_t kPedicleGrades = 5;
[[nodiscard]] PedicleGrade grade_of(double clearance_m);
/// "A".
[[nodiscard]] const char* name_of(PedicleGrade grade);
/// The version of the scale, for reports.
inline constexpr const char* kPedicleScale =
    "Gertzbein-Robbins, revised: A none, B < 2, C 2 to < 4, D 4 to < 6, E >= 6 mm of breach";

/// The least signed depth of a screw's side and flat tip below the bone's surface, from 6 mm past
/// the entry on, and where it occurs. Negative: the screw breaks through.
struct Clearance {
  double clearance_m = 0.0;
  double arc_length_m = 0.0;  ///< of that place, along the axis from the entry
  Vec3 outward;               ///< unit, from the axis towards it
  bool on_tip = false;        ///< else on the side
  Point<Vertebra> place;      ///< on the screw's surface
};

/// `bone` is closed and oriented outward, as that of a VertebraModel
/// (nav/geometry/surface_depth.h). Never below the true clearance, and above it by at most
/// `tolerance_m`: depth changes by no more than the distance moved, so a slice of the screw, or a
/// patch of a slice, is skipped once its middle is deeper than the shallowest place so far by its
/// radius minus the tolerance (branch and bound on a Lipschitz function: Piyavskii 1972). A descent
/// from the shallowest place makes it exact to micrometres where the surface is smooth.
/// Deterministic; allocates nothing. Empty for a screw of 6 mm or less and for an empty surface.
[[nodiscard]] std::optional<Clearance> least_clearance(const SurfaceIndex& bone,
                                                       const ScrewCylinder& screw,
                                                       double tolerance_m = 0.00005);

/// The least depth of the side in each of a series of planes across the axis, evenly spaced from 6
/// mm past the entry to the tip, both included; the circumference is sampled every 10°. Returns
/// false, and writes nothing, if `least_clearance` is empty.
bool clearance_profile(const SurfaceIndex& bone, const ScrewCylinder& screw,
                       std::span<double> least_m);

/// On which side of the screw the clearance is least, for the surgeon: "medial", "lateral",
/// "cranial", "caudal", "anterior" or "posterior", by the nearest axis of the vertebra (LPS); "tip"
/// for the tip.
[[nodiscard]] const char* direction_of(const Clearance& clearance, Side side);

}  // namespace orthonav::nav
