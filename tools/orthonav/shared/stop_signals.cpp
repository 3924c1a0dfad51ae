#include "tools/orthonav/shared/stop_signals.h"

#include <pthread.h>
#include <unistd.h>
#include <utility>

#include "base/last_words.h"

namespace orthonav::tools {
namespace {

/// Tells the waiting thread to end; not used for anything else.
constexpr int kOver = SIGUSR1;
/// The exit code by which shells report a program that a signal ended.
constexpr int kEndedBySignal = 128;

std::string name_of_signal(int signal) {
  return signal == SIGINT ? "SIGINT" : signal == SIGHUP ? "SIGHUP" : "SIGTERM";
}

bool is_ignored(int signal) {
  struct sigaction action {};
  return ::sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

}  // namespace

StopSignals::StopSignals() {
  sigemptyset(&waited_for_);
  for (const int signal : {SIGINT, SIGTERM, kOver}) {
    sigaddset(&waited_for_, signal);
  }
  if (!is_ignored(SIGHUP)) {
    sigaddset(&waited_for_, SIGHUP);
  }
  std::signal(SIGPIPE, SIG_IGN);
  pthread_sigmask(SIG_BLOCK, &waited_for_, &mask_before_);
  waiter_ = std::thread([this] { wait(); });
}

StopSignals::~StopSignals() {
  pthread_kill(waiter_.native_handle(), kOver);
  waiter_.join();
  pthread_sigmask(SIG_SETMASK, &mask_before_, nullptr);
}

void StopSignals::let_finish() {
  const MutexLock lock(mutex_);
  finishes_ = true;
}

void StopSignals::on_stop(std::function<void()> stop) {
  const MutexLock lock(mutex_);
  finishes_ = true;
  stop_ = std::move(stop);
  if (stop_ && caught_ != 0) {
    stop_();
  }
}

void StopSignals::outlast_terminal() {
  const MutexLock lock(mutex_);
  standard_error_.emplace();
}

std::optional<std::string> StopSignals::caught() const {
  const MutexLock lock(mutex_);
  return caught_ == 0 ? std::nullopt : std::optional<std::string>(name_of_signal(caught_));
}

int StopSignals::exit_code() const {
  const MutexLock lock(mutex_);
  return caught_ == 0 ? 0 : kEndedBySignal + caught_;
}

void StopSignals::wait() {
  for (;;) {
    int signal = 0;
    if (sigwait(&waited_for_, &signal) != 0) {
      continue;
    }
    if (signal == kOver) {
      return;
    }
    take(signal);
  }
}

void StopSignals::take(int signal) {
  const MutexLock lock(mutex_);
  if (signal != SIGHUP && std::exchange(asked_, true)) {
    _exit(kEndedBySignal + signal);
  }
  if (!finishes_) {
    last_words("\northonav: stopped by " + name_of_signal(signal) +
               "; every file that it wrote is whole\n");
    _exit(kEndedBySignal + signal);
  }
  if (caught_ != 0) {
    return;
  }
  caught_ = signal;
  const std::string line = "\northonav: " + name_of_signal(signal) +
                           ": finishing what was begun; once more ends at once\n";
  if (standard_error_) {
    standard_error_->add(line);
  } else {
    last_words(line);
  }
  if (stop_) {
    stop_();
  }
}

}  // namespace orthonav::tools
