#pragma once

#include <cstdint>
#include <optional>

#include "engine/session/raised.h"
#include "engine/session/session_steps.h"
#include "engine/session/tool_in_use.h"
#include "hal/api/devices.h"

namespace orthonav::engine {

/// Watches, pair by pair, for changes of the headset's map, the patient references and the tool in
/// use. Each look returns an event if something changed, which is answered before the next look.
class Watching {
 public:
  /// Whether a pair was processed.
  [[nodiscard]] bool begun() const { return map_epoch_.has_value(); }

  [[nodiscard]] std::optional<Event> look_at_map(const StereoFrame& frame,
                                                 const OperationInWork& work);
  /// Whether references moved against each other.
  [[nodiscard]] std::optional<Event> look_at_places(const OperationInWork& work);
  /// Whether a reference is seen.
  [[nodiscard]] std::optional<Event> look_for_reference(const OperationInWork& work, Timestamp now);
  /// Reports the places of the references whenever they change.
  void tell_places(const OperationInWork& work, Timestamp now);
  [[nodiscard]] std::optional<Event> look_at_tool(const OperationInWork& work,
                                                  std::optional<std::size_t> tool, Timestamp now);
  /// Until a drill is set the surgeon can go back and touch the landmark; afterwards the displayed
  /// SD grows.
  [[nodiscard]] std::optional<Raised> look_at_drift(const OperationInWork& work,
                                                    const Guiding& guiding, Timestamp now) const;

  /// A reference is in use but none is seen.
  [[nodiscard]] bool reference_hidden(const OperationInWork& work) const {
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
