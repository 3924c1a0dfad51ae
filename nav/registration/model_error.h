#pragma once

#include <array>
#include <vector>

#include "base/transform.h"

namespace orthonav::nav {

/// The error of a model relative to its bone, from segmentation.
struct ModelError {
  double sd_m = 0.0;
  double length_m = 0.007;  ///< over which its correlation, Matern's of order 3/2, falls to 1/e
};

/// The usual SD of a segmentation of a vertebra in CT.
inline constexpr double kUsualModelError_m = 0.0005;

/// A possible error of a model, and the logarithm of its probability, up to a constant.
struct ModelErrorHypothesis {
  ModelError error;
  double log_probability = 0.0;
};

/// The prior before a bone is touched: segmentations of vertebrae in CT are off by 0.3 to 0.8 mm,
/// with a correlation length of 5 to 10 mm. Nearly nine tenths of the probability lie there, the
/// rest between 0.1 mm, which is practically exact, and 1 mm.
[[nodiscard]] std::vector<ModelErrorHypothesis> model_error_hypotheses();

/// Matern's correlation of order 3/2, (1 + x) exp(-x), falls to 1/e at this x.
inline constexpr double kSmoothScale = 2.146193;
/// At `lengths` times that distance.
[[nodiscard]] double smooth_correlation(double lengths);
/// Covariance of a model's error at two places.
[[nodiscard]] double shared_error_m2(const ModelError& error, Vec3 a, Vec3 b);

/// How high the tip was above the bone, at one place.
struct EstimatedHeight {
  Point<Vertebra> at;
  double height_m = 0.0;
};

/// How an error of the model has moved a pose that was fitted to points on the bone. Places that
/// are touched later lie on the same model.
struct ModelShare {
  std::vector<Vec3> places_m;  ///< in the model's frame; none: not known
  /// Of each: the step (translation m, rotation vector rad, about the centre of the pose's
  /// uncertainty) from the fitted to the true pose, per metre that the bone lies above its model.
  std::vector<std::array<double, 6>> step;
  std::array<double, 36> rest{};  ///< the pose's covariance without the model's part, by rows
};

}  // namespace orthonav::nav
