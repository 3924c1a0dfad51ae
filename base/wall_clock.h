#pragma once

#include <chrono>

#include "base/time.h"

namespace orthonav {

/// This machine's time, counted from an arbitrary moment: paces what people watch, and serves
/// devices without a clock of their own.
class WallClock : public Clock {
 public:
  [[nodiscard]] Timestamp now() const override {
    return Timestamp(
        std::chrono::duration_cast<Duration>(std::chrono::steady_clock::now().time_since_epoch()));
  }
};

}  // namespace orthonav
