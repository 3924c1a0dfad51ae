#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/case/case.h"
#include "engine/evaluation/bone_registration.h"
#include "engine/evaluation/shaft_search.h"
#include "nav/guidance/screw_clearance.h"

namespace orthonav::engine {

/// The definitions of the figures below, for reports (docs/evaluation.md).
inline constexpr const char* kEvaluationDefinitions =
    "entry: where the axis meets the bone; entry (axis): the point of the axis nearest to the "
    "planned entry; depth: length in the bone less the planned length; clearance: least depth "
    "below the bone's surface of side and flat tip from 6 mm past the entry on; a bent wire's "
    "axis is its chord from entry to tip; two grades: neither is 90 % probable";

/// A planned screw as found in the scan.
struct ScrewInScan {
  std::size_t shaft = 0;  ///< among those found
  nav::ScrewCylinder
      cylinder;            ///< as placed: entry, axis, length in the bone, radius it is judged by
  double angle_rad = 0.0;  ///< between planned and placed axis
  double angle_sd_rad = 0.0;
  double entry_m = 0.0;       ///< planned entry to where the axis meets the bone
  double entry_axis_m = 0.0;  ///< planned entry to the nearest point of the axis
  double entry_axis_sd_m = 0.0;
  double target_m = 0.0;  ///< planned target to the tip
  double depth_m = 0.0;   ///< length in the bone minus the planned length
  double measured_radius_m = 0.0;
  bool radius_as_planned = false;  ///< measured as planned, so that it is judged by the planned one
  bool touched = false;            ///< its tip lies at another shaft
  /// If not, the cylinder ends where the shaft is surely metal: no target, no depth, and the
  /// clearance is that of the part that is seen.
  bool tip_seen = true;
  double bow_m = 0.0;                       ///< of a bent wire, from its chord
  std::optional<nav::Clearance> clearance;  ///< none if 6 mm or less lie in the bone
  std::optional<nav::ClearanceSpread> spread;
  /// For a wire, and for metal that looks thinner than the planned screw, as coarse slices make it:
  /// the clearance of the planned screw along its axis.
  std::optional<nav::Clearance> as_planned_screw;
};

/// The grades that the screw may have, A first: one if it is at least 90 % probable, else the most
/// probable ones that together are. Empty without a clearance.
[[nodiscard]] std::vector<nav::PedicleGrade> likely_grades(const ScrewInScan& screw);

struct EvaluatedScrew {
  nav::ScrewPlan plan;
  std::optional<ScrewInScan> placed;  ///< none: no shaft lies there
};

struct EvaluatedLevel {
  std::string label;
  std::optional<BoneRegistration> registration;  ///< only if accepted
  std::string refusal;                           ///< why there is none
  std::vector<EvaluatedScrew> screws;
};

/// Metal that is not a planned screw.
struct UnassignedMetal {
  Point<Scan> place;  ///< a shaft's tip, or the middle
  std::optional<std::size_t> shaft;
  double volume_m3 = 0.0;  ///< 0 for a shaft
  std::string where;       ///< "in L4", "outside the vertebrae"
};

struct Evaluation {
  double slices_m = 0.0;  ///< between the scan's slices: the longest edge of its voxels
  std::vector<Shaft> shafts;
  std::vector<EvaluatedLevel> levels;  ///< those with planned screws
  std::vector<UnassignedMetal> unassigned;
};

/// Finds wires and screws in a post-operative scan, registers each vertebra with planned screws to
/// its bone with the metal masked, and compares in the vertebra's frame. A planned screw is
/// assigned the shaft within 15 mm and 30° of it that runs in that bone, at most one each; a shaft
/// farther off is reported as unassigned, and the screw as not found. Refuses what `check_scan`
/// refuses, a case without planned screws, and a scan that the spine fits in two ways.
Result<Evaluation> evaluate(const Case& subject, const Volume& scan);

}  // namespace orthonav::engine
