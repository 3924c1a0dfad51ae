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

/// By what the tip's height deviates from its mean beside noise: a field over the bone, and how
/// hard each stroke was pressed.
struct HeightField {
  double variance_m2 = 0.0;  ///< of the field; 0: there is none
  double length_m = 0.0;     ///< over which its covariance falls to 1/e, exponentially
  double stroke_m2 = 0.0;    ///< variance of what a stroke's heights share, wherever it goes
  /// By this the noise forgets itself more slowly than the strokes' own heights tell.
  double noise_time = 1.0;

  [[nodiscard]] double correlation(double distance_m) const;
};

/// What is left of `seen` beside these.
[[nodiscard]] StrokeNoise noise_beside_field(const AlongStrokes& seen, const HeightField& field);

}  // namespace orthonav::nav
