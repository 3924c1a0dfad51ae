#pragma once

#include <atomic>
#include <chrono>
#include <utility>

#include "base/mutex.h"
#include "hal/api/devices.h"
#include "hal/sim/cameras/head_track.h"
#include "hal/sim/room/room_simulation.h"
#include "hal/sim/sim_headset.h"

namespace orthonav::sim {

/// The time at which a simulated headset is opened, as if the device had been running for a while.
inline constexpr Timestamp kSimStart{std::chrono::seconds(100)};

/// Follows wall time, or is set by the cameras.
class SimClock final : public Clock {
 public:
  explicit SimClock(Pace pace) : pace_(pace), opened_(std::chrono::steady_clock::now()) {}
  [[nodiscard]] Timestamp now() const override {
    if (pace_ == Pace::kRealtime) {
      return kSimStart +
             std::chrono::duration_cast<Duration>(std::chrono::steady_clock::now() - opened_);
    }
    return Timestamp(Duration(now_ns_.load()));
  }
  [[nodiscard]] bool runs_by_itself() const override { return pace_ == Pace::kRealtime; }
  void set(Timestamp now) { now_ns_.store(now.time_since_epoch().count()); }

 private:
  Pace pace_;
  std::chrono::steady_clock::time_point opened_;
  std::atomic<std::int64_t> now_ns_{kSimStart.time_since_epoch().count()};
};

/// The state that all parts of the simulated headset share.
struct SimRoom {
  Mutex mutex;
  SimClock clock;
  RoomSimulation simulation ORTHONAV_GUARDED_BY(mutex);
  HeadTrack head ORTHONAV_GUARDED_BY(mutex);
  Timestamp last_frame ORTHONAV_GUARDED_BY(mutex) = kSimStart;
  bool ended ORTHONAV_GUARDED_BY(mutex) = false;  ///< no pair comes any more

  SimRoom(RoomDescription room, const SimOptions& options, Vec3 eyes_in_rig)
      : clock(options.pace),
        simulation(std::move(room), options, eyes_in_rig, kSimStart),
        head(Random(options.seed).fork("head tracker"), options.error_model,
             options.told_sd_factor) {}
  /// The description of the room, which never changes.
  [[nodiscard]] const RoomDescription& described() const ORTHONAV_NO_THREAD_SAFETY_ANALYSIS {
    return simulation.room();
  }
};

}  // namespace orthonav::sim
