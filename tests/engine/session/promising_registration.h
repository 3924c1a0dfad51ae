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
  r.reasons = {{nav::RefusalReason::Kind::kTreAtScrews, 0.0024, 0.0015, {}, {}}};
  return r;
}

}  // namespace orthonav::engine::coach_test
