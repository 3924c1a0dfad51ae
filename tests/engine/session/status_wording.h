#pragma once

#include <limits>
#include <string>

#include "base/angle.h"
#include "engine/session/text/wording.h"

namespace orthonav::engine::wording_test {

using Reason = nav::RefusalReason::Kind;

inline constexpr double kInfinite = std::numeric_limits<double>::infinity();
inline const nav::BonePlace kLeftLamina{nav::BonePlace::Part::kLamina, Side::kLeft,
                                        nav::BonePlace::Height::kMiddle};

inline std::string text_of_reason(Reason kind, double value, double limit) {
  return text_of(nav::RefusalReason{kind, value, limit, {}, {}});
}

/// A measured wire so far off its plan, with limits of 2 degrees and 2 mm.
inline PlacedWire wire_off(double angle_deg, double entry_m) {
  PlacedWire wire;
  wire.axis.angle_rad = {angle_deg * kRadiansPerDegree, 0.9 * kRadiansPerDegree};
  wire.axis.entry_m = {entry_m, 0.0006};
  wire.angle_limit_rad = 2.0 * kRadiansPerDegree;
  wire.entry_limit_m = 0.002;
  return wire;
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
