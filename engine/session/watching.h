#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "engine/session/session_state.h"
#include "engine/session/steps/guiding.h"
#include "engine/session/text/messages.h"
#include "engine/session/watched_tools.h"
#include "engine/session/workflow/workflow.h"
#include "hal/api/devices.h"

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

/// Watches, pair by pair, for changes of the headset's map, the patient references and the tool in
/// use. Each look returns an event if something changed, which is answered before the next look.
class Watching {
 public:
  /// Whether a pair was processed.
  [[nodiscard]] bool begun() const { return map_epoch_.has_value(); }

  [[nodiscard]] std::optional<Event> look_at_map(const FrameHeader& frame,
                                                 const SessionState& work);
  /// Whether references moved against each other.
  [[nodiscard]] std::optional<Event> detect_reference_shift(const SessionState& work);
  /// Whether a reference is seen.
  [[nodiscard]] std::optional<Event> look_for_reference(const SessionState& work, Timestamp now);
  /// Reports the places of the references whenever they change.
  void publish_reference_poses(const SessionState& work, Timestamp now);
  [[nodiscard]] std::optional<Event> look_at_tool(const SessionState& work,
                                                  std::optional<std::size_t> tool, Timestamp now);
  /// Until a drill is set the surgeon can go back and touch the landmark; afterwards the displayed
  /// SD grows.
  [[nodiscard]] std::optional<FollowUpEvent> look_at_drift(const SessionState& work,
                                                           const Guiding& guiding,
                                                           Timestamp now) const;

  /// A reference is in use but none is seen.
  [[nodiscard]] bool reference_hidden(const SessionState& work) const {
    return work.anchored() && reference_hidden_;
  }
  [[nodiscard]] bool tool_lost() const { return in_use_.lost(); }
  void hide_guidance(bool hidden) { in_use_.hide_guidance(hidden); }
  [[nodiscard]] bool guidance_hidden() const { return in_use_.guidance_hidden(); }

 private:
  std::optional<std::int64_t> map_epoch_;  ///< of the newest pair
  std::int64_t reference_moves_ = 0;       ///< number already answered
  std::int64_t places_changed_ = 0;        ///< changes of the references' places already reported
  bool reference_hidden_ = true;
  ToolInUse in_use_;
};

}  // namespace orthonav::engine
