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

/// The recorded poses of a head, strictly increasing in time. Answers as a tracker that knows only
/// the past would: measured between two poses, predicted at constant velocity beyond the newest,
/// lost where poses lie more than HeadTracker::kMaxHeadPrediction apart or in another map.
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

/// The recorded device's own answers, by the newest frame's sequence number and the requested time.
/// A session with the same requests gets the same bits.
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
  // Most devices state a single covariance; consecutive equal ones are stored once.
  std::vector<PoseCovariance> covariances_;
};

}  // namespace orthonav::replay
