#pragma once

#include <cstdint>
#include <optional>

#include "base/result.h"
#include "base/time.h"

namespace orthonav::hl2ss {

/// Finds images that were stamped wrongly. A camera's sensor ticks and the host's stamps count the
/// same time, so that a stamp that leaps while the ticks go on as ever is wrong: real headsets
/// stamp an image far ahead or behind at times, and the next one rightly again.
///
/// Ticks are nanoseconds on a headset; servers that pass on their host's clock count in 100 ns, and
/// either is taken.
class StampCheck {
 public:
  /// Of the next image of one camera. An Error says why its time can't be used; where images go on
  /// contradicting the past, most of them agreeing with one another, those are believed after 20.
  Status check(Timestamp stamp, std::uint64_t sensor_ticks);
  /// A connection is new, and so may be the clocks.
  void restart() { *this = {}; }

 private:
  struct Moment {
    Timestamp stamp{};
    std::uint64_t sensor_ticks = 0;
  };
  /// By how much the stamp went further than the sensor's own clock.
  [[nodiscard]] static double ahead_s(const Moment& from, const Moment& to);
  void doubt(const Moment& next);

  std::optional<Moment> trusted_;
  std::optional<Moment> doubted_;
  int votes_ = 0;  ///< for the moment doubted
};

}  // namespace orthonav::hl2ss
