#pragma once

#include <vector>

#include "nav/registration/residual_units.h"

namespace orthonav::nav {

/// How the heights of one stroke go together, from point to point.
struct AlongStrokes {
  std::vector<double> covariance_m2;  ///< by lag, from 0 to the last that any hypothesis needs
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

/// By what the tip's height may deviate from its mean beside noise: a field over the bone (soft
/// tissue of uneven thickness, or a model that is not quite the bone; stationary, Gaussian, of
/// exponential covariance), and one height a stroke (a hand that presses through tissue as it
/// likes).
struct FieldHypothesis {
  double sd_m = 0.0;         ///< of the field; 0: there is none
  double length_m = 0.0;     ///< over which its covariance falls to 1/e
  double stroke_sd_m = 0.0;  ///< of the strokes' heights; 0: all are pressed alike
  /// Factor on how long the noise remembers, against what the strokes' heights say.
  double noise_time = 1.0;
  double probability = 0.0;

  /// Of the field.
  [[nodiscard]] double correlation(double distance_m) const;
};

/// What is left of `seen` beside these.
[[nodiscard]] StrokeNoise noise_beside_field(const AlongStrokes& seen,
                                             const FieldHypothesis& field);

}  // namespace orthonav::nav
