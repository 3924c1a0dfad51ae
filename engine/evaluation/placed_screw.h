#pragma once

#include <optional>

#include "engine/evaluation/evaluation.h"

namespace orthonav::engine {

/// The bone of a level, and where it lies in the scan.
struct BoneInScan {
  const nav::SurfaceIndex& surface;
  const BoneRegistration& registration;
};

/// The part of a shaft in the bone, from entry to tip (of a bent wire, the chord). It has the
/// planned radius if the measured one agrees with it. None if it does not enter the bone from
/// behind near the planned entry, lies more than 15 mm or 30° off the plan, or ends within 5 mm of
/// its entry.
[[nodiscard]] std::optional<nav::ScrewCylinder> cylinder_in_bone(const Shaft& shaft,
                                                                 const nav::ScrewPlan& plan,
                                                                 const BoneInScan& bone);

/// A distance of a cylinder from a plan, used for matching: in metres, where a degree counts as 0.2
/// mm.
[[nodiscard]] double distance_from_plan_m(const nav::ScrewCylinder& cylinder,
                                          const nav::ScrewPlan& plan);

/// All figures of the shaft matched to that screw.
[[nodiscard]] ScrewInScan placed_screw(const Shaft& shaft, const nav::ScrewPlan& plan,
                                       const nav::ScrewCylinder& cylinder, const BoneInScan& bone);

}  // namespace orthonav::engine
