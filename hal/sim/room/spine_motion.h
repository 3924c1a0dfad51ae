#pragma once

#include <string_view>

#include "hal/sim/error_model.h"
#include "hal/sim/room/noise.h"

namespace orthonav::sim {

/// How the patient's spine moves with the breath: mostly up and down, somewhat along the body, the
/// breath held for a moment at its end (the fourth power of a cosine: Lujan et al. 1999). The mean
/// over time is zero.
class SpineMotion {
 public:
  SpineMotion(Random random, const ErrorModel& error_model);
  /// The motion of the lower thoracic spine, in Room.
  [[nodiscard]] Vec3 at(double time_s) const;

 private:
  double extent_m_;
  double rate_hz_;
  double phase_ = 0.0;
};

/// Which part of that a level moves by: all at T10 to T12, where breath moves the spine most; 1.6
/// of 1.96 mm at L1 falling to 1.3 at L5 (lumbar levels of the same ten patients); half at the
/// sacrum and 0.6 at T1, falling evenly from T9 (estimates). Labels without a level's name move by
/// all.
[[nodiscard]] double fraction_of_breath(std::string_view label);

}  // namespace orthonav::sim
