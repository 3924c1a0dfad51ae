#include "hal/hl2ss/pair_mailbox.h"

#include <algorithm>
#include <utility>

namespace orthonav::hl2ss {
namespace {

/// Latencies of this many pairs are kept.
constexpr std::size_t kMaxFigures = 4096;

}  // namespace

void PairMailbox::note(std::vector<double>& figures, std::size_t& next, HostTime since) {
  const double ms = std::chrono::duration<double, std::milli>(HostClock::now() - since).count();
  if (figures.size() < kMaxFigures) {
    figures.push_back(ms);
  } else {
    figures[next++ % kMaxFigures] = ms;
  }
}

void PairMailbox::put(const Pairer::Pair& pair, std::int64_t map_epoch) {
  const MutexLock lock(mutex_);
  figures_.dropped += waits_ ? 1 : 0;
  newest_.sequence = next_sequence_++;
  newest_.map_epoch = map_epoch;
  newest_.time = pair.left.time;
  newest_.world_from_rig = pair.left.world_from_rig;
  newest_.repeats = of_pictures(pair.left.repeats, pair.right.repeats);
  std::swap(newest_.left, pair.left.image);
  std::swap(newest_.right, pair.right.image);
  arrived_ = std::max(pair.left.arrived, pair.right.arrived);
  if (tap_ != nullptr) {
    tap_->received(newest_);
  }
  waits_ = true;
  ++figures_.pairs;
  note(figures_.publish_ms, next_publish_, arrived_);
}

void PairMailbox::tap(PairTap* tap) {
  const MutexLock lock(mutex_);
  tap_ = tap;
}

std::optional<Timestamp> PairMailbox::waiting() const {
  const MutexLock lock(mutex_);
  return waits_ ? std::optional(newest_.time) : std::nullopt;
}

bool PairMailbox::take(StereoFrame& frame) {
  const MutexLock lock(mutex_);
  if (!waits_) {
    return false;
  }
  waits_ = false;
  frame.sequence = newest_.sequence;
  frame.map_epoch = newest_.map_epoch;
  frame.time = newest_.time;
  frame.world_from_rig = newest_.world_from_rig;
  frame.repeats = newest_.repeats;
  std::swap(newest_.left, frame.left);
  std::swap(newest_.right, frame.right);
  note(figures_.take_ms, next_take_, arrived_);
  return true;
}

void PairMailbox::fail(Error trouble) {
  const MutexLock lock(mutex_);
  trouble_ = std::move(trouble);
}

void PairMailbox::die(Error why) {
  const MutexLock lock(mutex_);
  died_ = std::move(why);
}

std::optional<Error> PairMailbox::trouble() {
  const MutexLock lock(mutex_);
  if (died_) {
    return died_;
  }
  return std::exchange(trouble_, std::nullopt);
}

void PairMailbox::clear() {
  const MutexLock lock(mutex_);
  waits_ = false;
}

PairMailbox::Figures PairMailbox::figures() const {
  const MutexLock lock(mutex_);
  return figures_;
}

}  // namespace orthonav::hl2ss
