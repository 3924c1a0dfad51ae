#pragma once

#include <optional>
#include <span>

#include "nav/registration/surface_fit.h"
#include "nav/registration/tre.h"

namespace orthonav::nav {

/// The uncertainty of a fit.
struct FitCovariance {
  PoseUncertainty uncertainty;
  /// The number of independent points that would determine the pose as well.
  double effective_points = 0.0;
  double standoff_sd_m = 0.0;  ///< of the mean height of the tip, where it was fitted
};

/// The covariance of a robust fit whose residuals are correlated from one point to the next: the
/// sandwich of M-estimators (Huber & Ronchetti 2009, section 6.3), its middle from the residuals'
/// own autocovariance along each stroke (Newey & West 1987, weights of Bartlett). Points in the
/// order of time; where they have none (most steps are leaps), neighbours within 5 mm count as one.
/// Nothing when a motion is undetermined.
[[nodiscard]] std::optional<FitCovariance> covariance_of(const SurfaceFit& fit);

}  // namespace orthonav::nav
