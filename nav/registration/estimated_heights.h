#pragma once

#include <vector>

#include "nav/registration/registration.h"
#include "nav/registration/residual_field.h"

namespace orthonav::nav {

/// How high the tip was above the bone along the strokes, according to the final fit: the standoff
/// plus the posterior mean of the components of `field`, without noise. One place per unit of the
/// fit's points, in the model's frame.
[[nodiscard]] std::vector<EstimatedHeight> estimated_heights(const SurfaceFit& fit,
                                                             const ResidualUnits& units,
                                                             const ResidualField& field);

/// Correlation of the heights of points that lie within 4 mm of each other on different strokes:
/// errors of the hand and the tracker are uncorrelated there, while tissue and a wrong model cause
/// correlation. 0 if there are fewer than 100 such pairs, or if the points are not in order.
[[nodiscard]] double correlation_across_strokes(const SurfaceFit& fit, const ResidualUnits& units);

}  // namespace orthonav::nav
