#pragma once

#include <optional>

#include "engine/evaluation/evaluation.h"

namespace orthonav::engine {

/// The bone of a level, and where it lies in the scan.
struct BoneInScan {
  const nav::SurfaceIndex& surface;
  const BoneRegistration& registration;
};

/// The axis of a shaft in the bone, from entry to tip (of a bent wire, the chord), of the planned
/// screw's or its own radius; none where it does not enter that bone as that screw would, within 15
/// mm and 30° of the plan.
[[nodiscard]] std::optional<nav::ScrewCylinder> cylinder_in_bone(const Shaft& shaft,
                                                                 const nav::ScrewPlan& plan,
                                                                 const BoneInScan& bone);

/// How far a cylinder lies from a plan, for choosing: metres, a degree counting 0.2 mm.
[[nodiscard]] double distance_from_plan_m(const nav::ScrewCylinder& cylinder,
                                          const nav::ScrewPlan& plan);

/// All figures of a shaft that is that screw.
[[nodiscard]] ScrewInScan placed_screw(const Shaft& shaft, const nav::ScrewPlan& plan,
                                       const nav::ScrewCylinder& cylinder, const BoneInScan& bone);

}  // namespace orthonav::engine
