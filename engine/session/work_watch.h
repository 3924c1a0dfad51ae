#pragma once

#include <cstddef>
#include <cstdint>
#include <exception>

namespace orthonav::engine {

/// The parts of an operation that can hang, each by itself.
enum class Part : std::uint8_t { kCamera, kTracker, kRenderer, kCoach, kVoice };
inline constexpr std::size_t kPartCount = 5;

/// Is told when a part begins and ends its work. From any thread; allocates nothing, never waits.
class WorkWatch {
 public:
  virtual ~WorkWatch() = default;
  virtual void begins(Part part) = 0;
  virtual void ends(Part part) = 0;
  /// The same for a task that a part works on beside the session, which goes on meanwhile.
  virtual void begins_beside(Part part) = 0;
  virtual void ends_beside(Part part) = 0;
};

/// A part is at work as long as this lives; null: nobody watches. Where an exception ends the
/// scope, the part stays marked as at work, so that whoever catches it can name the part.
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

}  // namespace orthonav::engine
