#pragma once

#include <vector>

#include "hal/sim/cameras/depth_renderer.h"

namespace orthonav::sim {

/// Adds the errors of a time-of-flight camera: biased by the material, noisy where little light
/// returns, wrapped, torn at edges, in whole millimetres. Deterministic: the picture depends only
/// on the arguments.
class DepthSensorErrors {
 public:
  DepthSensorErrors(const DepthModel& model, const DepthErrors& errors)
      : model_(model), errors_(errors) {}
  /// Fills the two images of `frame`; `seed` belongs to this picture.
  void measure(const DepthCalibration& calibration, const std::vector<DepthSight>& sights,
               std::uint64_t seed, DepthFrame& frame) const;

 private:
  struct Returned {
    double range_m = 0.0;
    double light = 0.0;  ///< 1: white paper that faces the camera at 0.5 m
  };
  [[nodiscard]] Returned returned(const DepthSight& sight, double cosine) const;

  DepthModel model_;
  DepthErrors errors_;
};

}  // namespace orthonav::sim
