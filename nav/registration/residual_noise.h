#pragma once

#include <vector>

#include "nav/registration/residual_units.h"

namespace orthonav::nav {

/// The autocovariance of the heights along strokes.
struct AlongStrokes {
  std::vector<double> covariance_m2;  ///< by lag, from 0 to the last that any hypothesis needs
  std::vector<double> distance_m;     ///< mean, between points of that lag
};
/// Heights are relative to the fit's standoff. Empty if there are too few points.
[[nodiscard]] AlongStrokes along_strokes(const SurfaceFit& fit, const ResidualUnits& units);

/// The error of hand and tracker, which is independent of the bone: a white part from point to
/// point, and one that wanders along a stroke (first-order autoregressive).
struct StrokeNoise {
  double white_m2 = 0.0;
  double wandering_m2 = 0.0;
  double kept = 0.0;  ///< fraction of the wandering part kept from one point to the next
};

/// How the tip's height may deviate from its mean, apart from noise: a field over the bone (soft
/// tissue of uneven thickness, or a model that differs from the bone; stationary, Gaussian, with
/// exponential covariance), and one height per stroke (varying pressure of the hand).
struct FieldHypothesis {
  double sd_m = 0.0;         ///< of the field; 0: there is none
  double length_m = 0.0;     ///< over which its covariance falls to 1/e
  double stroke_sd_m = 0.0;  ///< of the strokes' heights; 0: all pressed equally
  /// Factor on the noise's correlation time, relative to the one that the strokes' heights show.
  double noise_time = 1.0;
  double probability = 0.0;

  /// Correlation of the field.
  [[nodiscard]] double correlation(double distance_m) const;
};

/// The noise that remains of `seen` once the field and the strokes' heights are subtracted.
[[nodiscard]] StrokeNoise noise_beside_field(const AlongStrokes& seen,
                                             const FieldHypothesis& field);

}  // namespace orthonav::nav
