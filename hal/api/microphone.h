#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "base/result.h"
#include "base/time.h"

namespace orthonav {

/// One channel of sound as a device hears it: 16-bit samples, full scale ±32768, oldest first. A
/// device with more channels averages them. A microphone is read by one thread.
class Microphone {
 public:
  virtual ~Microphone() = default;
  /// Samples per second; never changes. Positive.
  [[nodiscard]] int sample_rate_hz() const { return do_sample_rate_hz(); }
  /// Moves the next samples, each delivered once, to the front of `samples` and returns how many
  /// there were; 0 if there are none. Does not block. A device that is not read in time drops the
  /// oldest samples; it never queues without limit. An Error says that the sound is lost for good
  /// (unplugged, disconnected) or that samples were dropped; the caller may keep reading.
  Result<std::size_t> read(std::span<std::int16_t> samples);
  /// When the newest sample that `read` delivered was heard, in the headset's time, so that a
  /// phrase can be stamped when it was spoken. Nothing before the first sample.
  [[nodiscard]] std::optional<Timestamp> newest_sample_time() const {
    return do_newest_sample_time();
  }

 private:
  [[nodiscard]] virtual int do_sample_rate_hz() const = 0;
  virtual Result<std::size_t> do_read(std::span<std::int16_t> samples) = 0;
  [[nodiscard]] virtual std::optional<Timestamp> do_newest_sample_time() const = 0;
};

}  // namespace orthonav
