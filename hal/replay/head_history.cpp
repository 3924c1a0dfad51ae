#include "hal/replay/head_history.h"

#include <algorithm>

namespace orthonav::replay {

Tracked<Transform<World, Rig>> HeadHistory::at(Timestamp time, Timestamp known_until) const {
  // Sums with it fit for every sample; differences with a time asked for might not.
  constexpr Duration kMaxGap = HeadTracker::kMaxHeadPrediction;
  const auto later = [](Timestamp t, const HeadSample& s) { return t < s.time; };
  const auto known = std::upper_bound(samples_.begin(), samples_.end(), known_until, later);
  Tracked<Transform<World, Rig>> answer;
  answer.time = time;
  if (known == samples_.begin()) return answer;
  const auto after = std::upper_bound(samples_.begin(), known, time, later);
  if (after == samples_.begin()) return answer;
  const HeadSample& before = *(after - 1);
  if (before.map_epoch != (known - 1)->map_epoch) return answer;
  if (before.time == time) {
    answer.value = before.world_from_rig;
    answer.origin = Origin::kMeasured;
    return answer;
  }
  const auto fraction = [time](const HeadSample& a, const HeadSample& b) {
    return seconds(time - a.time) / seconds(b.time - a.time);
  };
  if (after != known) {
    if (before.time + kMaxGap < after->time) return answer;
    answer.value =
        interpolated(before.world_from_rig, after->world_from_rig, fraction(before, *after));
    answer.origin = Origin::kMeasured;
    return answer;
  }
  if (before.time + kMaxGap < time) return answer;
  answer.origin = Origin::kPredicted;
  answer.value = before.world_from_rig;
  if (after - samples_.begin() < 2) return answer;
  const HeadSample& earlier = *(after - 2);
  if (before.time <= earlier.time + kMaxGap && before.map_epoch == earlier.map_epoch)
    answer.value =
        interpolated(earlier.world_from_rig, before.world_from_rig, fraction(earlier, before));
  return answer;
}

void HeadAnswers::add(std::int64_t sequence, const Tracked<Transform<World, Rig>>& answer) {
  if (covariances_.empty() || covariances_.back() != answer.covariance)
    covariances_.push_back(answer.covariance);
  answers_.try_emplace({sequence, answer.time},
                       Answer{answer.value, answer.origin, covariances_.size() - 1});
}

std::optional<Tracked<Transform<World, Rig>>> HeadAnswers::find(std::int64_t sequence,
                                                                Timestamp at) const {
  const auto found = answers_.find({sequence, at});
  if (found == answers_.end()) return std::nullopt;
  const Answer& answer = found->second;
  return Tracked<Transform<World, Rig>>{answer.value, at, answer.origin,
                                        covariances_[answer.covariance]};
}

}  // namespace orthonav::replay
