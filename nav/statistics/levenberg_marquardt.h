#pragma once

#include <functional>
#include <span>
#include <vector>

#include "base/result.h"

namespace orthonav::nav {

/// Writes the residuals of these parameters, always the same number; each divided by its standard
/// deviation.
using ResidualsOf = std::function<void(std::span<const double> parameters, std::vector<double>&)>;

struct LeastSquares {
  std::vector<double> parameters;
  std::vector<double> residuals;
  double sum_of_squares = 0.0;
  /// Inverse of the normal matrix at the end, row-major: the parameters' covariance if the
  /// residuals are scaled by their SDs.
  std::vector<double> covariance;
};

/// Parameters with the least sum of squared residuals near `start`, by Levenberg's and Marquardt's
/// method (Marquardt 1963, J SIAM 11:431) with central differences of 1e-6: the parameters are
/// metres and radians. Parameters that the residuals do not determine stay near their start.
/// Refuses residuals that are not finite at the start.
Result<LeastSquares> levenberg_marquardt(std::span<const double> start, const ResidualsOf& of,
                                         int most_iterations = 60);

}  // namespace orthonav::nav
