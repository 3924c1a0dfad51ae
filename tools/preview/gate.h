#pragma once

#include <cstdint>
#include <optional>

#include "base/mutex.h"
#include "base/time.h"

namespace orthonav::preview {

/// Decides when the next camera pair may pass: paused, step by step, at some speed relative to wall
/// time, or as fast as possible. If the headset's clock follows its pairs, as in the simulated room
/// and in a recording, a closed gate stops that clock. Thread-safe.
class Gate {
 public:
  /// `wall` must outlive it.
  explicit Gate(const Clock& wall) : wall_(wall) {}

  void pause(bool paused);
  [[nodiscard]] bool paused() const;
  /// While paused: lets this many more pairs through.
  void step(int pairs = 1);
  /// Seconds of the headset's clock per second of wall time; 0: as fast as possible.
  void set_speed(double speed);
  [[nodiscard]] double speed() const;
  /// As fast as possible until this many pairs have passed, then as before.
  void run_to(std::int64_t pairs);
  /// Pairs that passed since the start.
  [[nodiscard]] std::int64_t passed() const;
  /// Whether it is paused and no pair is on its way.
  [[nodiscard]] bool at_rest() const;
  /// Another stream begins: counts from 0 and forgets any goal.
  void restart();

  // For the camera.
  /// True: one is on its way, until one of the two below is called.
  [[nodiscard]] bool may_pass();
  /// A pair with this time went through.
  void pass(Timestamp time);
  /// There was no pair.
  void none_came();

 private:
  /// The times of headset and wall at one moment.
  struct Anchor {
    Timestamp pair;
    Timestamp wall;
  };

  [[nodiscard]] bool is_open() ORTHONAV_REQUIRES(mutex_);

  const Clock& wall_;
  mutable Mutex mutex_;
  bool paused_ ORTHONAV_GUARDED_BY(mutex_) = false;
  double speed_ ORTHONAV_GUARDED_BY(mutex_) = 1.0;
  int steps_ ORTHONAV_GUARDED_BY(mutex_) = 0;
  bool on_its_way_ ORTHONAV_GUARDED_BY(mutex_) = false;
  std::int64_t passed_ ORTHONAV_GUARDED_BY(mutex_) = 0;
  std::int64_t run_to_ ORTHONAV_GUARDED_BY(mutex_) = 0;
  std::optional<Timestamp> last_ ORTHONAV_GUARDED_BY(mutex_);
  std::optional<Anchor> anchor_ ORTHONAV_GUARDED_BY(mutex_);
};

}  // namespace orthonav::preview
