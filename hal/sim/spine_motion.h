#pragma once

#include "hal/sim/error_model.h"
#include "hal/sim/noise.h"

namespace orthonav::sim {

/// How the patient's spine moves with the breath: mostly up and down, somewhat along the body, the
/// breath held for a moment at its end (the fourth power of a cosine: Lujan et al. 1999). About the
/// middle of the motion, so that its mean over time is zero.
class SpineMotion {
 public:
  SpineMotion(Random random, const ErrorModel& error_model);
  /// In Room.
  [[nodiscard]] Vec3 at(double time_s) const;

 private:
  double extent_m_;
  double rate_hz_;
  double phase_ = 0.0;
};

}  // namespace orthonav::sim
