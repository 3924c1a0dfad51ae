#include "hal/replay/head_history.h"

#include <algorithm>

#include "hal/api/head_among.h"

namespace orthonav::replay {

Tracked<Transform<World, Rig>> HeadHistory::at(Timestamp time, Timestamp known_until) const {
  const auto later = [](Timestamp t, const HeadSample& s) { return t < s.time; };
  const auto known = std::upper_bound(samples_.begin(), samples_.end(), known_until, later);
  // A time before the map moved has no answer in the newest one.
  const auto of_older_map = [&](const HeadSample& s) {
    return s.map_epoch != (known - 1)->map_epoch;
  };
  return head_among(std::partition_point(samples_.begin(), known, of_older_map), known, time);
}

void HeadAnswers::add(std::int64_t sequence, const Tracked<Transform<World, Rig>>& answer) {
  if (covariances_.empty() || covariances_.back() != answer.covariance) {
    covariances_.push_back(answer.covariance);
  }
  answers_.try_emplace({sequence, answer.time},
                       Answer{answer.value, answer.status, covariances_.size() - 1});
}

std::optional<Tracked<Transform<World, Rig>>> HeadAnswers::find(std::int64_t sequence,
                                                                Timestamp at) const {
  const auto found = answers_.find({sequence, at});
  if (found == answers_.end()) {
    return std::nullopt;
  }
  const Answer& answer = found->second;
  return Tracked<Transform<World, Rig>>{answer.value, at, answer.status,
                                        covariances_[answer.covariance]};
}

}  // namespace orthonav::replay
