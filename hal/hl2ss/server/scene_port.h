#pragma once

#include <cstdint>

#include "base/mutex.h"
#include "base/random.h"
#include "hal/hl2ss/server/faults.h"
#include "hal/hl2ss/server/port.h"
#include "hal/hl2ss/server/unity_scene.h"

namespace orthonav::hl2ss {

/// The scene's port: a client's messages go to a `UnityScene`, which runs at 60 frames per second.
/// Runs on the server's network thread; the scene may be read from any.
class ScenePort {
 public:
  ScenePort(const Faults& faults, Random random) : faults_(faults), random_(random) {}
  /// Runs the frames that are due.
  void run(HostTime now) ORTHONAV_EXCLUDES(mutex_);
  [[nodiscard]] UnityObjects objects() const ORTHONAV_EXCLUDES(mutex_);
  /// Whether the next client may connect: the last one's queue has been processed.
  [[nodiscard]] bool is_free() const ORTHONAV_EXCLUDES(mutex_);
  // Individual faults, from any thread: the application is suspended; refuses a number of commands;
  // closes the connection; answers 7 to everything.
  void suspend(bool suspended) { suspended_ = suspended; }
  void refuse(int commands) ORTHONAV_EXCLUDES(mutex_);
  void cut() { cut_ = true; }
  void talk_nonsense(bool on) { nonsense_ = on; }

 private:
  Result<std::size_t> understand(Bytes said) ORTHONAV_EXCLUDES(mutex_);
  void left() ORTHONAV_EXCLUDES(mutex_);
  void inject(HostTime now) ORTHONAV_REQUIRES(mutex_);
  void answer(const std::vector<std::uint32_t>& answers);

  Faults faults_;
  Random random_;
  HostTime next_frame_{};
  HostTime stalled_until_{};
  std::atomic<bool> suspended_ = false;
  std::atomic<bool> cut_ = false;
  std::atomic<bool> nonsense_ = false;
  mutable Mutex mutex_;
  UnityScene scene_ ORTHONAV_GUARDED_BY(mutex_);
  bool gone_ ORTHONAV_GUARDED_BY(mutex_) = false;  ///< its last client's queue is being processed

 public:
  Port port{{[this](Bytes said) { return understand(said); }, [] {}, [this] { left(); }}};
};

}  // namespace orthonav::hl2ss
