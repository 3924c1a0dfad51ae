#pragma once

#include "base/vec.h"

namespace orthonav::bench {

/// The errors that a covariance predicts at a place.
class PredictedCoverage {
 public:
  explicit PredictedCoverage(const Mat3& covariance_m2);
  /// Whether an error lies in the ellipsoid that holds a fraction (0.68 or 0.95) of all errors.
  /// False without a covariance.
  [[nodiscard]] bool in_ellipsoid(Vec3 error_m, double fraction) const;
  /// Whether an error is within the length that this fraction of all errors does not exceed.
  [[nodiscard]] bool no_longer(Vec3 error_m, double fraction) const;

 private:
  Vec3 variances_m2_;  ///< along the principal axes
  Mat3 axes_;          ///< their directions, as columns
};

}  // namespace orthonav::bench
