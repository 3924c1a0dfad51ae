#pragma once

#include <csignal>
#include <functional>
#include <optional>
#include <string>
#include <thread>

#include "base/mutex.h"

namespace orthonav::tools {

/// What SIGINT (Ctrl-C) and SIGTERM do while it lives: the first asks for an end, so that what was
/// begun is finished and its files are closed; the second ends the program at once. Make it before
/// any other thread, since threads inherit that the signals are blocked.
class StopSignals {
 public:
  StopSignals();
  ~StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;

  /// Calls `stop` at the first signal, on a thread of its own; at once, where that was already.
  /// Null: nobody is to be asked any more.
  void on_stop(std::function<void()> stop);
  /// "SIGINT" or "SIGTERM"; absent before the first.
  [[nodiscard]] std::optional<std::string> caught() const;

 private:
  void wait();
  void take(int signal);

  sigset_t waited_for_{};
  sigset_t mask_before_{};
  mutable Mutex mutex_;
  std::function<void()> stop_ ORTHONAV_GUARDED_BY(mutex_);
  std::optional<std::string> caught_ ORTHONAV_GUARDED_BY(mutex_);
  std::thread waiter_;
};

}  // namespace orthonav::tools
