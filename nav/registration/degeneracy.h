#pragma once

#include <optional>
#include <span>

#include "nav/registration/registration.h"
#include "nav/registration/surface_fit.h"

namespace orthonav::nav {

/// What the strokes tell least of.
struct Degeneracy {
  UncertainMotion motion;
  std::optional<BonePlace> stroke_next;  ///< absent where no place would tell more
  Point<Vertebra> stroke_next_at;        ///< the middle of that place, where there is one
};

/// The motion that adds most to the error at the worst of the targets, and the part of the
/// reachable surface whose strokes would take most of it away.
[[nodiscard]] Degeneracy degeneracy_of(const VertebraModel& model,
                                       const PoseUncertainty& uncertainty,
                                       std::span<const Point<Vertebra>> targets);

/// Of the reachable surface's area, what lies within 5 mm of a fitted point.
[[nodiscard]] double coverage_fraction(const VertebraModel& model, const SurfaceFit& fit);

}  // namespace orthonav::nav
