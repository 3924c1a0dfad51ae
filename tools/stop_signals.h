#pragma once

#include <csignal>
#include <functional>
#include <optional>
#include <string>
#include <thread>

#include "base/mutex.h"

namespace orthonav::tools {

/// How SIGINT (Ctrl-C) and SIGTERM affect a command. By default they end it at once: unfinished
/// files have no name yet and disappear with it. A command that needs to finish its work says so
/// (`let_finish`, `on_stop`): then the first signal asks it to end, and the second ends it at once.
/// Made by main before any other thread, since threads inherit the blocked signals.
class StopSignals {
 public:
  StopSignals();
  ~StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;

  /// From now on the first signal only asks; the command checks `caught`.
  void let_finish();
  /// The same, and calls `stop` at the first signal, on a separate thread, or at once if the signal
  /// came already. Null: no function is called any more.
  void on_stop(std::function<void()> stop);
  /// "SIGINT" or "SIGTERM"; absent before the first.
  [[nodiscard]] std::optional<std::string> caught() const;
  /// The exit code of a command stopped by a signal, as in a shell: 128 plus the signal's number. 0
  /// before the first signal.
  [[nodiscard]] int exit_code() const;

 private:
  void wait();
  void take(int signal);

  sigset_t waited_for_{};
  sigset_t mask_before_{};
  mutable Mutex mutex_;
  std::function<void()> stop_ ORTHONAV_GUARDED_BY(mutex_);
  int caught_ ORTHONAV_GUARDED_BY(mutex_) = 0;  ///< 0: none yet
  bool finishes_ ORTHONAV_GUARDED_BY(mutex_) = false;
  std::thread waiter_;
};

}  // namespace orthonav::tools
