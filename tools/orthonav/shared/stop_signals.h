#pragma once

#include <csignal>
#include <functional>
#include <optional>
#include <string>
#include <thread>

#include "base/mutex.h"
#include "tools/orthonav/shared/unblocked_output.h"

namespace orthonav::tools {

/// How signals and the terminal affect a command: SIGINT (Ctrl-C), SIGTERM, and SIGHUP, which comes
/// when the terminal goes away. By default they end it at once: unfinished files have no name yet
/// and disappear with it. A command that needs to finish its work says so (`let_finish`,
/// `on_stop`): then the first signal asks it to end, and the second SIGINT or SIGTERM ends it at
/// once. A second SIGHUP does not: terminal, shell and session each send one when they end, and
/// often a SIGTERM too. Under nohup SIGHUP stays ignored. SIGPIPE ends nothing: a write says that
/// it failed.
///
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
  /// From now on a terminal that nobody reads holds up nothing: whatever is printed to standard
  /// error is written by a thread of its own, and dropped and counted if it is not taken. Call it
  /// before another thread prints.
  void outlast_terminal();
  /// "SIGINT", "SIGTERM" or "SIGHUP"; absent before the first.
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
  bool asked_ ORTHONAV_GUARDED_BY(mutex_) = false;  ///< by SIGINT or SIGTERM
  std::optional<UnblockedStandardError> standard_error_ ORTHONAV_GUARDED_BY(mutex_);
  std::thread waiter_;
};

}  // namespace orthonav::tools
