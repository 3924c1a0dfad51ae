#pragma once

#include <optional>
#include <span>

#include "nav/registration/registration.h"
#include "nav/registration/surface_fit.h"

namespace orthonav::nav {

/// The motion that the strokes determine least.
struct Degeneracy {
  UncertainMotion motion;
  std::optional<BonePlace> stroke_next;  ///< absent if no place would add information
  Point<Vertebra> stroke_next_at;        ///< the middle of that place, where there is one
};

/// The motion that adds most to the error at the worst of the targets, and the part of the
/// reachable surface where strokes would reduce it most.
[[nodiscard]] Degeneracy degeneracy_of(const VertebraModel& model,
                                       const PoseUncertainty& uncertainty,
                                       std::span<const Point<Vertebra>> targets);

/// The fraction of the reachable surface's area that lies within 5 mm of a fitted point.
[[nodiscard]] double coverage_fraction(const VertebraModel& model, const SurfaceFit& fit);

}  // namespace orthonav::nav
