#pragma once

#include <vector>

#include "base/vec.h"

namespace orthonav::nav {

/// Of a model about the bone that it was made of: segmentation.
struct ModelError {
  double sd_m = 0.0;
  double length_m = 0.007;  ///< alike over it: covariance `sd² exp(-distance / length)`
};

/// The usual SD of a segmentation of a vertebra in CT.
inline constexpr double kUsualModelError_m = 0.0005;

/// How a model may be off the bone, and the logarithm of how probable that is, up to a constant.
struct ModelErrorHypothesis {
  ModelError error;
  double log_probability = 0.0;
};

/// What is known before a bone is touched: segmentations of vertebrae in CT are off by 0.3 to 0.8
/// mm, alike over 5 to 10 mm. Two thirds of the probability lie there, the rest from 0.1 mm, which
/// is as good as exact, to 1 mm.
[[nodiscard]] std::vector<ModelErrorHypothesis> model_error_hypotheses();

/// Covariance of a model's error at two places.
[[nodiscard]] double shared_error_m2(const ModelError& error, Vec3 a, Vec3 b);

}  // namespace orthonav::nav
