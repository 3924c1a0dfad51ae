#pragma once

#include <algorithm>

#include "hal/api/devices.h"

namespace orthonav {

// A surgeon's head stays below these speeds; above them, World itself must have moved.
inline constexpr double kFastestHead_m_s = 2.0;
inline constexpr double kFastestHead_rad_s = 8.0;

/// Where the head is at a time, given samples (`time`, `world_from_rig`) of one map in the order of
/// their times: measured at and between them, predicted past the last as far as HeadTracker allows,
/// lost otherwise and in gaps longer than that.
template <class Iterator>
Tracked<Transform<World, Rig>> head_among(Iterator begin, Iterator end, Timestamp at) {
  // Adding it to a sample's time can't overflow; a difference to a requested time might.
  constexpr Duration kMaxGap = HeadTracker::kMaxHeadPrediction;
  Tracked<Transform<World, Rig>> answer;
  answer.time = at;
  const auto after = std::upper_bound(
      begin, end, at, [](Timestamp time, const auto& sample) { return time < sample.time; });
  if (after == begin) {
    return answer;
  }
  const auto& before = *(after - 1);
  const auto along = [at](const auto& a, const auto& b) {
    return interpolated(a.world_from_rig, b.world_from_rig,
                        seconds(at - a.time) / seconds(b.time - a.time));
  };
  if (before.time != at && before.time + kMaxGap < (after == end ? at : after->time)) {
    return answer;
  }
  answer.value = before.world_from_rig;
  answer.status = PoseStatus::kMeasured;
  if (before.time == at) {
    return answer;
  }
  if (after != end) {
    answer.value = along(before, *after);
    return answer;
  }
  answer.status = PoseStatus::kPredicted;
  const bool has_speed = after - begin > 1 && before.time <= (after - 2)->time + kMaxGap;
  if (has_speed) {
    answer.value = along(*(after - 2), before);
  }
  return answer;
}

}  // namespace orthonav
