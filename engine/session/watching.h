#pragma once

#include <cstdint>
#include <optional>

#include "engine/session/raised.h"
#include "engine/session/session_steps.h"
#include "engine/session/tool_in_use.h"
#include "hal/api/devices.h"

namespace orthonav::engine {

/// Watches, pair by pair, what happens without anybody saying or doing something: to the headset's
/// map, to the patient references and to the tool in use. Each look answers with an event where
/// something changed, which is answered before the next look.
class Watching {
 public:
  /// A pair was looked at.
  [[nodiscard]] bool begun() const { return map_epoch_.has_value(); }

  [[nodiscard]] std::optional<Event> look_at_map(const StereoFrame& frame,
                                                 const OperationInWork& work);
  /// Whether references moved against each other.
  [[nodiscard]] std::optional<Event> look_at_places(const OperationInWork& work);
  /// Whether one is seen.
  [[nodiscard]] std::optional<Event> look_for_reference(const OperationInWork& work, Timestamp now);
  /// Tells where the references lie, whenever that changes.
  void tell_places(const OperationInWork& work, Timestamp now);
  [[nodiscard]] std::optional<Event> look_at_tool(const OperationInWork& work,
                                                  std::optional<std::size_t> tool, Timestamp now);
  /// Before a drill is set the surgeon can go back and touch the landmark; once it is, the SD that
  /// is shown grows.
  [[nodiscard]] std::optional<Raised> look_at_drift(const OperationInWork& work,
                                                    const Guiding& guiding, Timestamp now) const;

  /// None is seen, where one is in use.
  [[nodiscard]] bool reference_hidden(const OperationInWork& work) const {
    return work.anchored() && reference_hidden_;
  }
  [[nodiscard]] bool tool_lost() const { return in_use_.lost(); }
  void hide_guidance(bool hidden) { in_use_.hide_guidance(hidden); }
  [[nodiscard]] bool guidance_hidden() const { return in_use_.guidance_hidden(); }

 private:
  std::optional<std::int64_t> map_epoch_;  ///< of the newest pair
  std::int64_t reference_moves_ = 0;       ///< that were answered
  std::int64_t places_changed_ = 0;        ///< of the references, as they were told
  bool reference_hidden_ = true;
  ToolInUse in_use_;
};

}  // namespace orthonav::engine
