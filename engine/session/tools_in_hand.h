#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "engine/session/guidance.h"
#include "engine/session/watched_tools.h"

namespace orthonav::engine {

/// Finds a tool that is in hand in a step that has no use for it: measured for half a second, near
/// the bone where that is known (its tip within 50 mm), and else in place of the step's own tool.
/// One that merely lies in view is not told of.
class ToolsInHand {
 public:
  /// After a pair. `own`: the tool of the step. Allocates nothing once it knows the tools.
  void look(const WatchedTools& tools, Step step, std::optional<std::size_t> own,
            const LevelState* level, Timestamp now);
  /// The first one; none where all is well.
  [[nodiscard]] std::optional<std::size_t> unused() const;

 private:
  struct Seen {
    std::optional<Timestamp> since;
    bool told = false;
  };
  std::vector<Seen> seen_;
};

}  // namespace orthonav::engine
