#pragma once

#include "base/vec.h"

namespace orthonav::bench {

/// What a covariance says of the errors to expect at a place.
class PredictedCoverage {
 public:
  explicit PredictedCoverage(const Mat3& covariance_m2);
  /// Whether an error lies in the ellipsoid that holds a share (0.68 or 0.95) of all. Never where
  /// the covariance is none.
  [[nodiscard]] bool in_ellipsoid(Vec3 error_m, double fraction) const;
  /// Whether an error is no longer than a share of all.
  [[nodiscard]] bool no_longer(Vec3 error_m, double fraction) const;

 private:
  Vec3 variances_m2_;  ///< along the principal axes
  Mat3 axes_;          ///< their directions, by columns
};

}  // namespace orthonav::bench
