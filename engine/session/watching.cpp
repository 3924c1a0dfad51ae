#include "engine/session/watching.h"

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

std::optional<Event> Watching::look_at_map(const FrameHeader& frame, const SessionState& work) {
  const bool moved = map_epoch_ && *map_epoch_ != frame.map_epoch;
  map_epoch_ = frame.map_epoch;
  // With a patient reference nothing depends on the map.
  return moved && !work.anchored() ? std::optional(Event::kMapMoved) : std::nullopt;
}

std::optional<Event> Watching::detect_reference_shift(const SessionState& work) {
  const nav::Anchor* anchor = work.tools.tracker().anchor();
  if (anchor == nullptr || std::exchange(reference_moves_, anchor->moves) == anchor->moves) {
    return std::nullopt;
  }
  return Event::kReferenceMoved;
}

std::optional<Event> Watching::look_for_reference(const SessionState& work, Timestamp now) {
  const nav::Anchor* anchor = work.tools.tracker().anchor();
  if (anchor == nullptr) {
    return std::nullopt;
  }
  const bool hidden = anchor->stale(now, work.options.stale_after);
  if (std::exchange(reference_hidden_, hidden) == hidden) {
    return std::nullopt;
  }
  return hidden ? Event::kReferenceHidden : Event::kReferenceSeen;
}

void Watching::publish_reference_poses(const SessionState& work, Timestamp now) {
  const nav::Anchor* anchor = work.tools.tracker().anchor();
  // Observers added later are notified then.
  if (anchor != nullptr && work.heard() && !anchor->places.empty() &&
      std::exchange(places_changed_, anchor->places_changed) != anchor->places_changed) {
    work.observer->references_placed(now, anchor->places);
  }
}

std::optional<Event> Watching::look_at_tool(const SessionState& work,
                                            std::optional<std::size_t> tool, Timestamp now) {
  if (tool != in_use_.tool()) {
    in_use_ = ToolInUse(tool);
  }
  if (!tool) {
    return std::nullopt;
  }
  return in_use_.look(work.tools.watch(*tool), now, work.options.stale_after);
}

std::optional<FollowUpEvent> Watching::look_at_drift(const SessionState& work,
                                                     const Guiding& guiding, Timestamp now) const {
  if (work.step != Step::kGuide) {
    return std::nullopt;
  }
  const auto& found = work.level().bone_found;
  if (!found || !work.options.steps.landmark || guiding.drill().phase != nav::DrillPhase::kAway ||
      !(found->drift_sd_m(now) > kMaxWalked_m)) {
    return std::nullopt;
  }
  return FollowUpEvent{Event::kBoneUnchecked,
                       BoneUnchecked{seconds(now - found->time), 2.0 * found->drift_sd_m(now)}};
}

}  // namespace orthonav::engine
