#pragma once

#include <optional>
#include <vector>

#include "base/mutex.h"
#include "hal/api/devices.h"
#include "hal/hl2ss/pairer.h"

namespace orthonav::hl2ss {

/// Holds the newest pair until it is taken or a newer one replaces it: late pairs are dropped,
/// never queued. Thread-safe; times increase.
class PairMailbox {
 public:
  /// The pair must be later than the one before it.
  void put(const Pairer::Pair& pair, std::int64_t map_epoch);
  /// Null: nobody sees the pairs that are put.
  void tap(PairTap* tap);
  /// The time of the waiting pair.
  [[nodiscard]] std::optional<Timestamp> waiting() const;
  /// Exchanges it for `frame`, whose buffers later pairs reuse; false when none waits.
  bool take(StereoFrame& frame);
  /// Reports what went wrong; the waiting pair is discarded.
  void fail(Error trouble);
  /// The thread that puts pairs has ended: `trouble` returns this from now on.
  void die(Error why);
  [[nodiscard]] std::optional<Error> trouble();
  /// Discards the waiting pair: it must not be used for guidance any more.
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
  PairTap* tap_ ORTHONAV_GUARDED_BY(mutex_) = nullptr;
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
