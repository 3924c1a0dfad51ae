#pragma once

#include <vector>

#include "base/vec.h"

namespace orthonav::nav {

/// The error of a model relative to its bone, from segmentation.
struct ModelError {
  double sd_m = 0.0;
  double length_m = 0.007;  ///< correlation length: covariance `sd² exp(-distance / length)`
};

/// The usual SD of a segmentation of a vertebra in CT.
inline constexpr double kUsualModelError_m = 0.0005;

/// A possible error of a model, and the logarithm of its probability, up to a constant.
struct ModelErrorHypothesis {
  ModelError error;
  double log_probability = 0.0;
};

/// The prior before a bone is touched: segmentations of vertebrae in CT are off by 0.3 to 0.8 mm,
/// with a correlation length of 5 to 10 mm. Two thirds of the probability lie there, the rest
/// between 0.1 mm, which is practically exact, and 1 mm.
[[nodiscard]] std::vector<ModelErrorHypothesis> model_error_hypotheses();

/// Covariance of a model's error at two places.
[[nodiscard]] double shared_error_m2(const ModelError& error, Vec3 a, Vec3 b);

}  // namespace orthonav::nav
