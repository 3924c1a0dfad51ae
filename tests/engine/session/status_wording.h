#pragma once

#include <limits>
#include <string>

#include "engine/session/wording.h"

namespace orthonav::engine::wording_test {

using Reason = nav::RefusalReason::Kind;

inline constexpr double kInfinite = std::numeric_limits<double>::infinity();
inline const nav::BonePlace kLeftLamina{nav::BonePlace::Part::kLamina, Side::kLeft,
                                        nav::BonePlace::Height::kMiddle};

inline std::string text_of_reason(Reason kind, double value, double limit) {
  return text_of(nav::RefusalReason{kind, value, limit, {}, {}});
}

/// All of the status line but the step.
inline std::string line_with(const Message& message) {
  StatusLine line;
  line.message = &message;
  return detail_text(line);
}

inline std::string line_with(const StepState& state) {
  StatusLine line;
  line.state = state;
  return detail_text(line);
}

}  // namespace orthonav::engine::wording_test
