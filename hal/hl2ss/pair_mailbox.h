#pragma once

#include <optional>
#include <vector>

#include "base/mutex.h"
#include "hal/api/devices.h"
#include "hal/hl2ss/pairer.h"

namespace orthonav::hl2ss {

/// The newest pair, until somebody takes it or a newer one replaces it: what is late is dropped,
/// never queued. Thread-safe; times increase.
class PairMailbox {
 public:
  /// The pair must be later than the one before it.
  void put(const Pairer::Pair& pair, std::int64_t map_epoch);
  /// The time of the pair that waits.
  [[nodiscard]] std::optional<Timestamp> waiting() const;
  /// Copies it into `frame`; false when none waits.
  bool take(StereoFrame& frame);
  /// What went wrong since the last question; the pair that waited is void with it.
  void fail(Error trouble);
  /// The thread that puts has died: `trouble` answers with this from now on.
  void die(Error why);
  [[nodiscard]] std::optional<Error> trouble();
  /// What was put is void: nobody may guide on it any more.
  void clear();

  struct Figures {
    std::int64_t pairs = 0;
    std::int64_t dropped = 0;
    std::vector<double> publish_ms;
    std::vector<double> take_ms;
  };
  [[nodiscard]] Figures figures() const;

 private:
  static void note(std::vector<double>& figures, std::size_t& next, HostTime since);

  mutable Mutex mutex_;
  StereoFrame newest_ ORTHONAV_GUARDED_BY(mutex_);
  bool waits_ ORTHONAV_GUARDED_BY(mutex_) = false;
  std::int64_t next_sequence_ ORTHONAV_GUARDED_BY(mutex_) = 0;
  HostTime arrived_ ORTHONAV_GUARDED_BY(mutex_){};
  std::optional<Error> trouble_ ORTHONAV_GUARDED_BY(mutex_);
  std::optional<Error> died_ ORTHONAV_GUARDED_BY(mutex_);
  Figures figures_ ORTHONAV_GUARDED_BY(mutex_);
  std::size_t next_publish_ ORTHONAV_GUARDED_BY(mutex_) = 0;
  std::size_t next_take_ ORTHONAV_GUARDED_BY(mutex_) = 0;
};

}  // namespace orthonav::hl2ss
