#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "hal/api/devices.h"

namespace orthonav::replay {

struct HeadSample {
  Timestamp time{};
  Transform<World, Rig> world_from_rig;
  std::int64_t map_epoch = 0;
};

/// The recorded poses of a head, strictly increasing in time, as a tracker that knows only the past
/// would answer from them: measured between two of them, predicted at constant velocity beyond the
/// newest, lost where they lie more than HeadTracker::kMaxHeadPrediction apart or in another map.
class HeadHistory {
 public:
  HeadHistory() = default;
  explicit HeadHistory(std::vector<HeadSample> samples) : samples_(std::move(samples)) {}
  /// Only samples up to `known_until` exist yet.
  [[nodiscard]] Tracked<Transform<World, Rig>> at(Timestamp time, Timestamp known_until) const;
  [[nodiscard]] const std::vector<HeadSample>& samples() const { return samples_; }

 private:
  std::vector<HeadSample> samples_;
};

/// What the recorded device itself answered, by the newest frame's sequence number and the time
/// asked for. A session that asks the same gets the same bits.
class HeadAnswers {
 public:
  void add(std::int64_t sequence, const Tracked<Transform<World, Rig>>& answer);
  [[nodiscard]] std::optional<Tracked<Transform<World, Rig>>> find(std::int64_t sequence,
                                                                   Timestamp at) const;

 private:
  struct Answer {
    Transform<World, Rig> value;
    PoseStatus status = PoseStatus::kLost;
    std::size_t covariance = 0;
  };
  std::map<std::pair<std::int64_t, Timestamp>, Answer> answers_;
  // Most devices know one covariance; each distinct one in a row is held once.
  std::vector<PoseCovariance> covariances_;
};

}  // namespace orthonav::replay
