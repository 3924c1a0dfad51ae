#pragma once

#include <algorithm>
#include <initializer_list>

#include "hal/api/shown_status.h"
#include "nav/tracking/tool.h"

namespace orthonav::engine {

namespace tool_steps_detail {
constexpr bool one_of(Step step, std::initializer_list<Step> steps) {
  return std::find(steps.begin(), steps.end(), step) != steps.end();
}
}  // namespace tool_steps_detail

/// In which steps each instrument may be used: the one place that says so.
[[nodiscard]] constexpr bool used_in(nav::ToolRole role, Step step) {
  using enum Step;
  using nav::ToolRole;
  using tool_steps_detail::one_of;
  switch (role) {
    case ToolRole::kPointer:
      return one_of(step, {kDigitize, kRegistering, kVerify, kAccepted, kRod});
    case ToolRole::kGuide:
      return one_of(step, {kAccepted, kGuide, kPlaced});
    case ToolRole::kAwl:  // makes the dimple, and opens the cortex
      return one_of(step, {kAccepted, kGuide});
    case ToolRole::kWire:  // stands while it is measured
      return one_of(step, {kGuide, kPlaced});
    case ToolRole::kDrill:
    case ToolRole::kTap:
    case ToolRole::kScrewdriver:
      return one_of(step, {kGuide});
    case ToolRole::kReference:
      return true;
  }
  return false;
}

}  // namespace orthonav::engine
