#pragma once

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <optional>
#include <vector>

#include "engine/session/guidance.h"
#include "engine/session/shown_status.h"
#include "engine/session/watched_tools.h"
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
      return one_of(step, {kDigitize, kRegistering, kVerify, kTouchLandmark, kRod});
    case ToolRole::kGuide:
      return one_of(step, {kTouchLandmark, kGuide, kMeasureWire});
    case ToolRole::kAwl:  // makes the landmark, and opens the cortex
      return one_of(step, {kTouchLandmark, kGuide});
    case ToolRole::kWire:  // stands while it is measured
      return one_of(step, {kGuide, kMeasureWire});
    case ToolRole::kDrill:
    case ToolRole::kTap:
    case ToolRole::kScrewdriver:
      return one_of(step, {kGuide});
    case ToolRole::kReference:
      return true;
  }
  return false;
}

/// Finds a tool that is in hand in a step that does not use it: measured for half a second, with
/// its tip within 50 mm of the bone or, if the bone is not known, in place of the step's own tool.
/// A tool that merely lies in view is not reported.
class ToolsInHand {
 public:
  /// Called after a pair. `own`: the tool of the step. Does not allocate once it knows the tools.
  void look(const WatchedTools& tools, Step step, std::optional<std::size_t> own,
            const LevelState* level, Timestamp now);
  /// The first such tool; none if all is well.
  [[nodiscard]] std::optional<std::size_t> unused() const;

 private:
  struct Seen {
    std::optional<Timestamp> since;
    bool told = false;
  };
  std::vector<Seen> seen_;
};

}  // namespace orthonav::engine
