#pragma once

#include <cstdint>
#include <optional>

#include "base/result.h"
#include "base/time.h"

namespace orthonav::hl2ss {

/// Detects images with wrong stamps. A camera's sensor ticks and the host's stamps measure the same
/// time, so a stamp that jumps while the ticks continue normally is wrong: real headsets sometimes
/// stamp an image far ahead or behind, and the next one correctly again.
///
/// Ticks are nanoseconds on a headset; servers that pass on their host's clock count in units of
/// 100 ns. Both are accepted.
class StampCheck {
 public:
  /// Checks the next image of one camera. An Error says why its time can't be used; if images keep
  /// contradicting the past but mostly agree with one another, they are accepted after 20.
  Status check(Timestamp stamp, std::uint64_t sensor_ticks);
  /// By how much the stamps leapt, if the image checked last is the one from which on that is
  /// believed: the clock was set, or the first image was wrong.
  [[nodiscard]] std::optional<Duration> leapt() const { return leapt_; }
  /// For a new connection, which may have new clocks.
  void restart() { *this = {}; }

 private:
  struct Moment {
    Timestamp stamp{};
    std::uint64_t sensor_ticks = 0;
  };
  /// How much further the stamp advanced than the sensor's own clock.
  [[nodiscard]] static double ahead_s(const Moment& from, const Moment& to);
  void doubt(const Moment& next);

  std::optional<Moment> trusted_;
  std::optional<Moment> doubted_;
  int votes_ = 0;  ///< for the doubted moment
  std::optional<Duration> leapt_;
};

}  // namespace orthonav::hl2ss
