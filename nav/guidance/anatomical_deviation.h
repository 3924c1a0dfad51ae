#pragma once

#include <optional>

#include "nav/guidance/screw.h"
#include "nav/registration/tre.h"

namespace orthonav::nav {

/// The directions in which a surgeon describes a tool relative to a planned screw, in Vertebra
/// (LPS, docs/frames.md). Unit, at right angles to each other.
struct ScrewDirections {
  Vec3 inward;   ///< along the planned axis, into the bone
  Vec3 cranial;  ///< in the plane of the planned axis and the vertebra's +z
  Vec3 medial;   ///< in the axial plane, from the screw's side towards the midline
};

/// Empty where the words would mislead: cranial more than 60° off +z, or medial more than 60° off
/// the x axis. No pedicle screw has such a direction.
[[nodiscard]] std::optional<ScrewDirections> directions_of(const ScrewPlan& plan);

/// A number and the SD of its error; the SD is infinite if unknown.
struct NumberWithSd {
  double value = 0.0;
  double sd = 0.0;
};

/// A tool relative to a planned screw, in a surgeon's directions. It always says where the tool is,
/// never where it has to go.
///
/// The offset is that of the tip from the planned axis, at right angles to it. The angles are those
/// of the tool's direction into the bone, in two planes through the planned axis: with `medial`
/// (axial, but for the screw's own tilt) and with `cranial` (sagittal, but for the screw's own
/// convergence). Both are therefore zero on the plan, and for small angles their squares add up to
/// that of the angle in space; in the vertebra's own planes, a convergent screw's sagittal angle
/// would be larger than the angle by which the tool has to be turned.
struct AnatomicalDeviation {
  NumberWithSd tip_cranial_m;    ///< > 0: the tip lies cranial of the axis
  NumberWithSd tip_medial_m;     ///< > 0: medial
  NumberWithSd aim_cranial_rad;  ///< > 0: the tool aims more cranial than planned, (-pi, pi]
  NumberWithSd aim_medial_rad;   ///< > 0: more medial
  NumberWithSd depth_m;          ///< of the tip past the entry along the planned axis
};

/// `tool` is its axis: the tip as its point, and a unit direction into the bone. `uncertainty` is
/// that of the tool's pose relative to the bone, as `with_tool` gives it; null: not known. It is
/// propagated to first order. Empty if `directions_of` is empty or the tool is not finite.
[[nodiscard]] std::optional<AnatomicalDeviation> anatomical_deviation(
    const ScrewPlan& plan, const Axis<Vertebra>& tool, const PoseUncertainty* uncertainty);

}  // namespace orthonav::nav
