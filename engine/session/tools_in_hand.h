#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "engine/session/guidance.h"
#include "engine/session/shown_status.h"
#include "engine/session/watched_tools.h"
#include "nav/tracking/tool.h"

namespace orthonav::engine {

/// In which steps each instrument may be used: the one place that says so.
[[nodiscard]] constexpr bool used_in(nav::ToolRole role, Step step) {
  using nav::ToolRole;
  if (role == facts_of(step).tool || role == ToolRole::kReference) {
    return true;
  }
  switch (step) {
    case Step::kTouchLandmark:  // the awl makes it, the guide's tip is held against the pointer's
      return role == ToolRole::kGuide || role == ToolRole::kAwl;
    case Step::kGuide:
      return role != ToolRole::kPointer;
    case Step::kMeasureWire:
      return role == ToolRole::kWire;
    default:
      return false;
  }
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
