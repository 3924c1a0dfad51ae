#pragma once

#include <vector>

#include "hal/sim/depth_renderer.h"

namespace orthonav::sim {

/// Makes of what is there what a time-of-flight camera measures: biased by the material, noisy
/// where little light comes back, wrapped, torn at edges, in whole millimetres. Deterministic: the
/// picture depends on the arguments alone.
class DepthSensorErrors {
 public:
  DepthSensorErrors(const DepthModel& model, const DepthErrors& errors)
      : model_(model), errors_(errors) {}
  /// Fills the two images of `frame`; `seed` is this picture's.
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
