#pragma once

#include <cstddef>
#include <cstdint>
#include <exception>

namespace orthonav::engine {

/// What an operation needs to go on; each may hang by itself.
enum class Part : std::uint8_t { kCamera, kTracker, kRenderer, kCoach, kVoice };
inline constexpr std::size_t kPartCount = 5;

/// Is told what works. Allocates nothing and waits for nobody; from any thread.
class WorkWatch {
 public:
  virtual ~WorkWatch() = default;
  virtual void begins(Part part) = 0;
  virtual void ends(Part part) = 0;
};

/// A part works as long as this lives; null: nobody watches. One that an exception leaves stays at
/// what it was at, so that it can be named.
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
