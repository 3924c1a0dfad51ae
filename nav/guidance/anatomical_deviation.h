#pragma once

#include <optional>

#include "nav/guidance/screw.h"
#include "nav/registration/tre.h"

namespace orthonav::nav {

/// The directions in which a surgeon says how a tool stands against a planned screw, in Vertebra
/// (LPS, docs/frames.md). Unit, at right angles to each other.
struct ScrewDirections {
  Vec3 inward;   ///< along the planned axis, into the bone
  Vec3 cranial;  ///< in the plane of the planned axis and the vertebra's +z
  Vec3 medial;   ///< in the axial plane, from the screw's side towards the midline
};

/// None where the words would mislead: cranial more than 60° off +z, or medial more than 60° off
/// the x axis. No pedicle screw runs so.
[[nodiscard]] std::optional<ScrewDirections> directions_of(const ScrewPlan& plan);

/// A number and the SD of its error; infinite where nobody knows it.
struct NumberWithSd {
  double value = 0.0;
  double sd = 0.0;
};

/// A tool against a planned screw, in a surgeon's directions. Always where the tool is, never where
/// it has to go.
///
/// The offset is that of the tip from the planned axis, at right angles to it. The angles are those
/// of the tool's direction into the bone, in two planes through the planned axis: with `medial`
/// (axial, but for the screw's own tilt) and with `cranial` (sagittal, but for the screw's own
/// convergence). So both are zero on the plan, and for small angles their squares add up to that of
/// the angle in space; in planes of the vertebra itself a convergent screw's sagittal angle would
/// come out larger than the tool has to be turned.
struct AnatomicalDeviation {
  NumberWithSd tip_cranial_m;    ///< > 0: the tip lies cranial of the axis
  NumberWithSd tip_medial_m;     ///< > 0: medial
  NumberWithSd aim_cranial_rad;  ///< > 0: the tool aims more cranial than planned, (-pi, pi]
  NumberWithSd aim_medial_rad;   ///< > 0: more medial
  NumberWithSd depth_m;          ///< of the tip past the entry along the planned axis
};

/// `tool` is a point and direction of its axis: the tip, and unit into the bone. `uncertainty` is
/// that of the tool's pose relative to the bone, as `with_tool` gives it; null: not known. It is
/// carried over to first order. None where `directions_of` gives none, and for a tool that is not
/// finite.
[[nodiscard]] std::optional<AnatomicalDeviation> anatomical_deviation(
    const ScrewPlan& plan, const Axis<Vertebra>& tool, const PoseUncertainty* uncertainty);

}  // namespace orthonav::nav
