#pragma once

#include <vector>

#include "nav/registration/registration.h"
#include "nav/registration/residual_field.h"

namespace orthonav::nav {

/// How high the tip stood above the bone along the strokes, by the fit after its last step: the
/// standoff and the posterior mean of what `field` is made of, noise left out. One place a unit of
/// the fit's points, in the model's frame.
[[nodiscard]] std::vector<EstimatedHeight> estimated_heights(const SurfaceFit& fit,
                                                             const ResidualUnits& units,
                                                             const ResidualField& field);

/// Correlation of the heights of points that lie within 4 mm of each other on different strokes:
/// a hand's and a tracker's errors have none in common there, tissue and a wrong model have. 0
/// where fewer than 100 such pairs are, or points are in no order.
[[nodiscard]] double correlation_across_strokes(const SurfaceFit& fit, const ResidualUnits& units);

}  // namespace orthonav::nav
