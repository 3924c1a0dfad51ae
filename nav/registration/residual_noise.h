#pragma once

#include <vector>

#include "nav/registration/residual_units.h"

namespace orthonav::nav {

/// How the heights of one stroke go together, from point to point.
struct AlongStrokes {
  std::vector<double> covariance_m2;  ///< by lag, from 0 on
  std::vector<double> distance_m;     ///< mean, between points of that lag
};
/// Heights about the fit's standoff. Empty where there are too few points.
[[nodiscard]] AlongStrokes along_strokes(const SurfaceFit& fit, const ResidualUnits& units);

/// The error of a hand and a tracker, which knows nothing of the bone: white from point to point,
/// and one that wanders along a stroke (first-order autoregressive).
struct StrokeNoise {
  double white_m2 = 0.0;
  double wandering_m2 = 0.0;
  double kept = 0.0;  ///< of what wanders, from one point to the next
};

/// What is left of `seen` beside a field over the bone that has this variance and forgets itself
/// exponentially over `length_m`.
[[nodiscard]] StrokeNoise noise_beside_field(const AlongStrokes& seen, double field_m2,
                                             double length_m);

}  // namespace orthonav::nav
