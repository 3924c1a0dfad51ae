#include "tools/stop_signals.h"

#include <pthread.h>
#include <unistd.h>
#include <cstdio>
#include <utility>

namespace orthonav::tools {
namespace {

/// Tells the waiting thread to end; not used for anything else.
constexpr int kOver = SIGUSR1;
/// The exit code by which shells report a program that a signal ended.
constexpr int kEndedBySignal = 128;

const char* name_of_signal(int signal) { return signal == SIGINT ? "SIGINT" : "SIGTERM"; }

}  // namespace

StopSignals::StopSignals() {
  sigemptyset(&waited_for_);
  for (const int signal : {SIGINT, SIGTERM, kOver}) {
    sigaddset(&waited_for_, signal);
  }
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
  if (caught_ != 0) {
    _exit(kEndedBySignal + signal);
  }
  if (!finishes_) {
    std::fprintf(stderr, "\northonav: stopped by %s; every file that it wrote is whole\n",
                 name_of_signal(signal));
    _exit(kEndedBySignal + signal);
  }
  caught_ = signal;
  std::fprintf(stderr, "\northonav: %s: finishing what was begun; once more ends at once\n",
               name_of_signal(signal));
  if (stop_) {
    stop_();
  }
}

}  // namespace orthonav::tools
