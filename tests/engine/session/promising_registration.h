#pragma once

#include "nav/registration/registration.h"

namespace orthonav::engine::coach_test {

inline const nav::BonePlace kLeftLamina{nav::BonePlace::Part::kLamina, Side::kLeft,
                                        nav::BonePlace::Height::kMiddle};

/// Unique, but not yet precise enough to be accepted.
inline nav::Registration promising() {
  nav::Registration r;
  r.log_likelihood_ratio = 30.0;
  r.predicted_tre_m = 0.0024;
  r.stroke_next = kLeftLamina;
  r.tre_99_m = 0.0032;  // of which the limit is 5/8
  r.reasons = {{nav::RefusalReason::Kind::kTre99AtScrews, r.tre_99_m, 0.002, {}, {}}};
  return r;
}

}  // namespace orthonav::engine::coach_test
