#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "engine/session/tool_watch.h"
#include "engine/session/workflow.h"

namespace orthonav::engine {

/// The tool that the present step works with, if any, and how it was last seen. Another tool is
/// another object: one that was just taken into use was not lost, it has not been found yet.
class ToolInUse {
 public:
  ToolInUse() = default;
  explicit ToolInUse(std::optional<std::size_t> tool) : tool_(tool) {}

  /// Once for each pair; what changed, if anything.
  [[nodiscard]] std::optional<Event> look(const ToolWatch& watch, Timestamp now,
                                          Duration stale_after);
  void hide_guidance(bool hidden) { guidance_hidden_ = hidden; }
  [[nodiscard]] const std::optional<std::size_t>& tool() const { return tool_; }
  /// Seen once, and not any more.
  [[nodiscard]] bool lost() const { return seen_ == Seen::kLost || seen_ == Seen::kStale; }
  [[nodiscard]] bool guidance_hidden() const { return guidance_hidden_; }

 private:
  enum class Seen : std::uint8_t { kNever, kMeasured, kLost, kStale };

  std::optional<std::size_t> tool_;
  Seen seen_ = Seen::kNever;
  bool guidance_hidden_ = false;
};

}  // namespace orthonav::engine
