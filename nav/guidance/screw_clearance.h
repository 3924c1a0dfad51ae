#pragma once

#include <array>
#include <optional>
#include <span>

#include "nav/guidance/screw_cylinder.h"
#include "nav/registration/model_error.h"
#include "nav/registration/tre.h"

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

// Depths are read off the screw's surface in two ways, because two things are promised. The least
// of them is proved: from the depth of the axis, which bounds that of a whole slice of the screw,
// some 130 places suffice, where a grid of equal proof needs 1,300 (planners ask hundreds of
// times). But once the pose is uncertain any wall may become the nearest, and a place that the
// proof passed over counts: for the spread and the profile the whole surface is sampled in rows.
//
// `bone` is closed and oriented outward, as that of a VertebraModel (nav/geometry/surface_depth.h).
// All are deterministic and allocate nothing.

/// Never below the true clearance, and above it by at most 0.05 mm: depth changes by no more than
/// the distance moved, so a slice of the screw, or a patch of a slice, is skipped once its middle
/// is deeper than the shallowest place so far by its radius minus that (branch and bound on a
/// Lipschitz function: Piyavskii 1972). A descent from the shallowest place makes it exact to
/// micrometres where the surface is smooth. Empty for a screw of 6 mm or less and for an empty
/// surface.
[[nodiscard]] std::optional<Clearance> least_clearance(const SurfaceIndex& bone,
                                                       const ScrewCylinder& screw);

/// The same, but empty if it does not exceed `above_m`. Usually a few places suffice to tell, so
/// the best of many screws is found sooner.
[[nodiscard]] std::optional<Clearance> least_clearance_above(double above_m,
                                                             const SurfaceIndex& bone,
                                                             const ScrewCylinder& screw);

/// The least depth of the side in each of a series of planes across the axis, evenly spaced from 6
/// mm past the entry to the tip, both included; the circumference is sampled every 10°. Returns
/// false, and writes nothing, if `least_clearance` is empty.
bool clearance_profile(const SurfaceIndex& bone, const ScrewCylinder& screw,
                       std::span<double> least_m);

/// A screw's clearance, given the uncertainty of its pose.
struct ClearanceSpread {
  double lower_95_m = 0.0;  ///< with 95 % probability the clearance is above it
  std::array<double, kPedicleGrades> grade_probability{};  ///< A to E; they add up to 1
  /// The probability of that grade alone.
  [[nodiscard]] double probability(PedicleGrade grade) const {
    return grade_probability[static_cast<std::size_t>(grade)];
  }
};

/// A screw's clearance, and its spread if the uncertainty of the pose is known.
struct ScrewClearance {
  Clearance least;
  std::optional<ClearanceSpread> spread;
};

/// `least_clearance` at the assumed pose; unless `pose` is null, with its spread when the true pose
/// relative to the bone differs from that by a normally distributed motion (t, w) about a centre c
/// with the covariance of `pose`, and the bone's walls from those of its model by `model`. No
/// spread if the covariance is not finite.
///
/// The depth of a place p on the screw, to first order d + n·(t + w × (p - c)) + f(q) with n the
/// direction in which the depth grows and q the wall nearest to p, is linear in the motion and in
/// the amplitudes of f, a sum of plane waves whose covariance is about that of `model` (Rahimi and
/// Recht 2007, "Random features for large-scale kernel machines"). Nobody touches the walls of a
/// pedicle, so `model` should be the usual error of a segmentation, whatever was found where the
/// bone was stroked. The clearance is the least depth over some 180 places all over the screw, so
/// another wall may become the nearest. A single normal distribution about the nearest place would
/// miss that and be too optimistic in a narrow pedicle (two equally near walls cost another 0.3
/// SD). The distribution of the least depth is taken over 1024 cases, the same for every screw and
/// frame, so that figures of similar screws differ only by the screws and don't flicker: motions
/// are quasi-random points in six dimensions (Roberts 2018, the additive recurrence R6), made
/// normal.
///
/// Each place speaks for its arc of the circumference, for which the wall is taken as a plane. That
/// and the curvature of walls err to the safe side: against exact clearances in the same motions,
/// at ten screws of real vertebrae, the bound is 0.01 mm too low for SDs of 0.3 mm and 0.2° along
/// and about each axis, 0.05 mm for 0.8 mm and 0.6°, 0.12 mm for 1.5 mm and 1.1°, on average. It
/// covers only what `pose` and `model` hold.
[[nodiscard]] std::optional<ScrewClearance> screw_clearance(
    const SurfaceIndex& bone, const ScrewCylinder& screw, const PoseUncertainty* pose,
    const ModelError& model = {kUsualModelError_m});

/// On which side of the screw the clearance is least, for the surgeon: "medial", "lateral",
/// "cranial", "caudal", "anterior" or "posterior", by the nearest axis of the vertebra (LPS); "tip"
/// for the tip.
[[nodiscard]] const char* direction_of(const Clearance& clearance, Side side);

}  // namespace orthonav::nav
