#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "base/result.h"

struct SRC_STATE_tag;

namespace orthonav::voice {

/// Converts a stream of sound to another rate (libsamplerate), with a delay of a few milliseconds.
class Resampler {
 public:
  /// Refuses rates outside [8000, 192000] Hz.
  static Result<Resampler> create(int from_hz, int to_hz);
  /// Appends the converted samples.
  Status push(std::span<const std::int16_t> samples, std::vector<std::int16_t>& out);

 private:
  struct Free {
    void operator()(SRC_STATE_tag* state) const;
  };
  std::unique_ptr<SRC_STATE_tag, Free> state_;  ///< null: the rates are the same
  double ratio_ = 1.0;
  std::vector<float> in_;
  std::vector<float> out_;
};

}  // namespace orthonav::voice
