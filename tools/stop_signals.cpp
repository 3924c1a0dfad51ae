#include "tools/stop_signals.h"

#include <pthread.h>
#include <unistd.h>
#include <cstdio>
#include <utility>

namespace orthonav::tools {
namespace {

/// Tells the waiting thread that it is over; nobody else sends or waits for it.
constexpr int kOver = SIGUSR1;
/// As a shell says it of a program that a signal ended.
constexpr int kEndedBySignal = 128;

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

void StopSignals::on_stop(std::function<void()> stop) {
  const MutexLock lock(mutex_);
  stop_ = std::move(stop);
  if (stop_ && caught_) {
    stop_();
  }
}

std::optional<std::string> StopSignals::caught() const {
  const MutexLock lock(mutex_);
  return caught_;
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
  if (caught_) {
    _exit(kEndedBySignal + signal);
  }
  caught_ = signal == SIGINT ? "SIGINT" : "SIGTERM";
  std::fprintf(stderr, "\northonav: %s: finishing what was begun; once more ends at once\n",
               caught_->c_str());
  if (stop_) {
    stop_();
  }
}

}  // namespace orthonav::tools
