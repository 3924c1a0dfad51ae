#include "engine/session/tool_in_use.h"

#include <utility>

namespace orthonav::engine {

std::optional<Event> ToolInUse::look(const ToolWatch& watch, Timestamp now, Duration stale_after) {
  if (watch.measured_now()) {
    if (std::exchange(seen_, Seen::kMeasured) != Seen::kMeasured) {
      return Event::kTrackingRegained;
    }
  } else if (seen_ == Seen::kMeasured) {
    seen_ = Seen::kLost;
    return Event::kTrackingLost;
  } else if (seen_ == Seen::kLost && !watch.fresh(now, stale_after)) {
    seen_ = Seen::kStale;
    return Event::kPoseStale;
  }
  return std::nullopt;
}

}  // namespace orthonav::engine
