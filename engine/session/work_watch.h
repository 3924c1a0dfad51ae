#pragma once

#include <cstddef>
#include <cstdint>
#include <exception>
#include <string_view>

namespace orthonav::engine {

/// The parts of an operation that can hang independently.
enum class Part : std::uint8_t { kCamera, kTracker, kRenderer, kCoach, kVoice, kRegistration };
inline constexpr std::size_t kPartCount = 6;

/// Notified when a part begins and ends its work, from any thread. Must not allocate or block.
class WorkWatch {
 public:
  virtual ~WorkWatch() = default;
  virtual void begins(Part part) = 0;
  virtual void ends(Part part) = 0;
  /// The same for a task that a part does in parallel with the session.
  virtual void begins_beside(Part part) = 0;
  virtual void ends_beside(Part part) = 0;
};

/// Marks a part as at work while this object lives; null: no watch. If an exception ends the scope,
/// the part stays marked, so that the handler can name it.
class [[nodiscard]] Working {
 public:
  Working(WorkWatch* watch, Part part) : watch_(watch), part_(part) {
    if (watch_) {
      watch_->begins(part_);
    }
  }
  ~Working() {
    if (watch_ && std::uncaught_exceptions() == exceptions_) {
      watch_->ends(part_);
    }
  }
  Working(const Working&) = delete;
  Working& operator=(const Working&) = delete;

 private:
  WorkWatch* watch_;
  Part part_;
  int exceptions_ = std::uncaught_exceptions();
};

/// "tracker": in English, for logs.
[[nodiscard]] std::string_view word_of(Part part);
/// "tracker stalled: nothing is guided".
[[nodiscard]] std::string_view stalled_text(Part part);

}  // namespace orthonav::engine
