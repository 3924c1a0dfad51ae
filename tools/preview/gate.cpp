#include "tools/preview/gate.h"

#include <algorithm>
#include <chrono>

namespace orthonav::preview {
namespace {

/// A larger lag is not made up for in a rush.
constexpr Duration kMaxLag = std::chrono::milliseconds(200);

}  // namespace

void Gate::pause(bool paused) {
  const MutexLock lock(mutex_);
  paused_ = paused;
  steps_ = 0;
  run_to_ = 0;
  anchor_.reset();
}

bool Gate::paused() const {
  const MutexLock lock(mutex_);
  return paused_;
}

void Gate::step(int pairs) {
  const MutexLock lock(mutex_);
  if (paused_) {
    steps_ += pairs;
  }
}

void Gate::set_speed(double speed) {
  const MutexLock lock(mutex_);
  speed_ = std::max(speed, 0.0);
  anchor_.reset();
}

double Gate::speed() const {
  const MutexLock lock(mutex_);
  return speed_;
}

void Gate::run_to(std::int64_t pairs) {
  const MutexLock lock(mutex_);
  run_to_ = pairs;
}

std::int64_t Gate::passed() const {
  const MutexLock lock(mutex_);
  return passed_;
}

void Gate::restart() {
  const MutexLock lock(mutex_);
  on_its_way_ = false;
  passed_ = 0;
  run_to_ = 0;
  steps_ = 0;
  last_.reset();
  anchor_.reset();
}

bool Gate::at_rest() const {
  const MutexLock lock(mutex_);
  return !on_its_way_;
}

bool Gate::may_pass() {
  const MutexLock lock(mutex_);
  return on_its_way_ = is_open();
}

bool Gate::is_open() {
  if (steps_ > 0 || passed_ < run_to_) {
    return true;
  }
  if (paused_) {
    return false;
  }
  if (speed_ <= 0.0 || !last_) {
    return true;
  }
  const Timestamp now = wall_.now();
  if (!anchor_) {
    anchor_ = Anchor{*last_, now};
  }
  const Duration due = from_seconds(seconds(*last_ - anchor_->pair) / speed_);
  const Duration late = now - anchor_->wall - due;
  if (late < Duration::zero()) {
    return false;
  }
  if (late > kMaxLag) {
    anchor_ = Anchor{*last_, now};
  }
  return true;
}

void Gate::pass(Timestamp time) {
  const MutexLock lock(mutex_);
  on_its_way_ = false;
  ++passed_;
  steps_ = std::max(0, steps_ - 1);
  last_ = time;
}

void Gate::none_came() {
  const MutexLock lock(mutex_);
  on_its_way_ = false;
}

}  // namespace orthonav::preview
