#pragma once

#include <array>
#include <atomic>
#include <optional>

#include "base/time.h"
#include "engine/session/work_watch.h"

namespace orthonav::engine {

/// Since when each part has been at one thing, by the device's clock. The tracking thread and the
/// drawing thread watch each other by it (docs/watchdogs.md). From any thread; waits for nobody.
class Heartbeats : public WorkWatch {
 public:
  /// A part that is at one thing for longer than `limit` has stalled.
  Heartbeats(const Clock& clock, Duration limit);
  void begins(Part part) override;
  void ends(Part part) override;

  /// What the tracking thread hangs in: the part that it waits for, where that is another.
  [[nodiscard]] std::optional<Part> tracking_stalled() const;
  [[nodiscard]] bool drawing_stalled() const { return stalled(Part::kRenderer, clock_.now()); }
  /// What the tracking thread is at, however long.
  [[nodiscard]] std::optional<Part> tracking() const;

 private:
  [[nodiscard]] std::int64_t since(Part part) const {
    return since_ns_[static_cast<std::size_t>(part)].load(std::memory_order_acquire);
  }
  [[nodiscard]] bool stalled(Part part, Timestamp now) const;

  const Clock& clock_;
  Duration limit_;
  std::array<std::atomic<std::int64_t>, kPartCount> since_ns_;  ///< kRests: at nothing
};

}  // namespace orthonav::engine
