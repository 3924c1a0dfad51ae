#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <optional>

#include "base/time.h"
#include "engine/session/work_watch.h"

namespace orthonav::engine {

/// A task beside the tracking thread, which nothing waits for, has stalled after this: many times
/// as long as a registration takes that is compared with every level of a spine.
inline constexpr Duration kTaskStallsAfter = std::chrono::seconds(10);

/// When each part began its current work, by the device's clock. The tracking thread and the
/// drawing thread watch each other with it (docs/watchdogs.md). Callable from any thread; never
/// waits.
class Heartbeats : public WorkWatch {
 public:
  /// A part that works on one thing for longer than `limit` has stalled; a task beside the tracking
  /// thread has after `kTaskStallsAfter`.
  Heartbeats(const Clock& clock, Duration limit);
  void begins(Part part) override;
  void ends(Part part) override;
  void begins_beside(Part part) override;
  void ends_beside(Part part) override;

  /// The part in which the tracking thread hangs: the innermost one at work. Absent if it does not
  /// hang.
  [[nodiscard]] std::optional<Part> tracking_stalled() const;
  [[nodiscard]] bool drawing_stalled() const { return stalled(Part::kRenderer, clock_.now()); }
  /// The part whose task beside the tracking thread has stalled. Absent if none has.
  [[nodiscard]] std::optional<Part> stalled_beside() const;
  /// The innermost part at work on the tracking thread, however long it has been at work.
  [[nodiscard]] std::optional<Part> tracking() const;

 private:
  /// When each part began, in nanoseconds of the clock; kRests: idle.
  using Beats = std::array<std::atomic<std::int64_t>, kPartCount>;
  void begin(Beats& beats, Part part) const;
  [[nodiscard]] std::int64_t since(Part part) const {
    return at_work_[static_cast<std::size_t>(part)].load(std::memory_order_acquire);
  }
  [[nodiscard]] static bool late(std::int64_t since_ns, Timestamp now, Duration limit);
  [[nodiscard]] bool stalled(Part part, Timestamp now) const {
    return late(since(part), now, limit_);
  }

  const Clock& clock_;
  Duration limit_;
  Beats at_work_;
  Beats beside_;
};

}  // namespace orthonav::engine
