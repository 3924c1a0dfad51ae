#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "base/mutex.h"
#include "hal/api/devices.h"

namespace orthonav::hl2ss {

/// Poses of the last seconds. The head is measured at and between them, predicted at constant
/// velocity beyond, and lost where they lie too far apart or in another map. Thread-safe.
class HeadTrack final : public HeadTracker {
 public:
  void add(Timestamp time, const Transform<World, Rig>& world_from_rig, std::int64_t map_epoch);
  /// The epoch of the newest pose's map. Resets `world_from_rig` if it disagrees with the head's
  /// pose at that time in this map, since it may be of another map.
  std::int64_t place(Timestamp at, std::optional<Transform<World, Rig>>& world_from_rig) const;
  /// Forgets all poses: the connection is gone.
  void lose();

 private:
  struct Sample {
    Timestamp time{};
    Transform<World, Rig> world_from_rig;
  };
  static constexpr std::size_t kMaxSamples = 128;

  [[nodiscard]] Tracked<Transform<World, Rig>> do_world_from_rig(Timestamp at) const override;
  [[nodiscard]] std::optional<Timestamp> do_newest_measurement() const override;

  mutable Mutex mutex_;
  std::deque<Sample> samples_ ORTHONAV_GUARDED_BY(mutex_);  ///< all in one map
  std::int64_t map_epoch_ ORTHONAV_GUARDED_BY(mutex_) = 0;
};

}  // namespace orthonav::hl2ss
