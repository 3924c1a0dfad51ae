#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "base/mutex.h"
#include "hal/api/devices.h"

namespace orthonav::hl2ss {

/// Finds out that the map has moved: by two poses in a row that no head could have had. A stamp
/// alone never moves a map.
class MapWatch {
 public:
  /// Takes the next pose; true when World is another one from this pose on. One that is not later
  /// than the pose before says nothing, and is passed over.
  bool moved(Timestamp time, const Transform<World, Rig>& world_from_rig);
  /// Whatever comes next lies in another map.
  void break_off() { broken_off_ = true; }

 private:
  struct Seen {
    Timestamp time{};
    Transform<World, Rig> world_from_rig;
  };
  [[nodiscard]] bool is_possible(const Seen& next) const;

  std::optional<Seen> last_;
  std::optional<Seen> before_;  ///< the one before it, near enough to tell a speed
  bool broken_off_ = false;
};

/// Poses of the last seconds: measured at them and between two, predicted at constant velocity
/// beyond, lost where they lie too far apart or in another map. Thread-safe.
class HeadTrack final : public HeadTracker {
 public:
  void add(Timestamp time, const Transform<World, Rig>& world_from_rig, std::int64_t map_epoch);
  /// The epoch of the newest pose's map. Resets `world_from_rig` where it disagrees with where the
  /// head was at that time in this map: it may be of another one.
  std::int64_t place(Timestamp at, std::optional<Transform<World, Rig>>& world_from_rig) const;
  /// Nothing is known any more: the connection is gone.
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
  std::deque<Sample> samples_ ORTHONAV_GUARDED_BY(mutex_);  ///< all of one map
  std::int64_t map_epoch_ ORTHONAV_GUARDED_BY(mutex_) = 0;
};

}  // namespace orthonav::hl2ss
