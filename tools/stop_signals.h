#pragma once

#include <csignal>
#include <functional>
#include <optional>
#include <string>
#include <thread>

#include "base/mutex.h"

namespace orthonav::tools {

/// What SIGINT (Ctrl-C) and SIGTERM do to a command. They end it at once: files that it had not
/// finished have no name yet and go with it. A command that would rather finish what it is at says
/// so
/// (`let_finish`, `on_stop`): then the first signal asks for an end, and the second ends it at
/// once. Made by main before any other thread, since threads inherit that the signals are blocked.
class StopSignals {
 public:
  StopSignals();
  ~StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;

  /// From now on the first signal only asks; the command looks at `caught`.
  void let_finish();
  /// The same, and calls `stop` at the first signal, on a thread of its own; at once, where that
  /// was already. Null: nobody is to be asked any more.
  void on_stop(std::function<void()> stop);
  /// "SIGINT" or "SIGTERM"; absent before the first.
  [[nodiscard]] std::optional<std::string> caught() const;
  /// What a command returns that a signal stopped, as a shell has it: 128 and the signal's number.
  /// 0 before the first signal.
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
