#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "engine/session/tool_watch.h"
#include "engine/session/workflow.h"

namespace orthonav::engine {

/// The tool that the present step works with, if any, and how it was last seen. Each tool gets a
/// new object: one that has just come into use is not lost, but not yet found.
class ToolInUse {
 public:
  ToolInUse() = default;
  explicit ToolInUse(std::optional<std::size_t> tool) : tool_(tool) {}

  /// Called once for each pair; returns what changed, if anything.
  [[nodiscard]] std::optional<Event> look(const ToolWatch& watch, Timestamp now,
                                          Duration stale_after);
  void hide_guidance(bool hidden) { guidance_hidden_ = hidden; }
  [[nodiscard]] const std::optional<std::size_t>& tool() const { return tool_; }
  /// It was seen before, but is not now.
  [[nodiscard]] bool lost() const { return seen_ == Seen::kLost || seen_ == Seen::kStale; }
  [[nodiscard]] bool guidance_hidden() const { return guidance_hidden_; }

 private:
  enum class Seen : std::uint8_t { kNever, kMeasured, kLost, kStale };

  std::optional<std::size_t> tool_;
  Seen seen_ = Seen::kNever;
  bool guidance_hidden_ = false;
};

}  // namespace orthonav::engine
