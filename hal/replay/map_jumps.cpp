#include "hal/replay/map_jumps.h"

#include <algorithm>
#include <iterator>

#include "hal/api/map_watch.h"
#include "hal/replay/layout.h"

namespace orthonav::replay {

std::int64_t epoch_at(const EpochsByTicks& recorded, std::int64_t ticks) {
  const auto next = recorded.lower_bound(ticks);
  return (next == recorded.end() ? std::prev(next) : next)->second;
}

std::vector<std::int64_t> map_jumps(const PosesByTicks& poses, const EpochsByTicks& recorded) {
  std::vector<std::int64_t> jumps;
  if (poses.empty()) {
    return jumps;
  }
  // Only differences count. Beyond what a time can hold all are one, and ignored.
  const std::int64_t first = poses.begin()->first;
  MapWatch watch;
  std::int64_t epoch = epoch_at(recorded, first);
  for (const auto& [ticks, pose] : poses) {
    const std::int64_t own_epoch = epoch_at(recorded, ticks);
    if (own_epoch != epoch) {
      watch.break_off();
    }
    if (watch.moved(from_ticks_100ns(std::min(ticks - first, kMaxTicks)), pose) &&
        own_epoch == epoch) {
      jumps.push_back(ticks);
    }
    epoch = own_epoch;
  }
  return jumps;
}

std::int64_t jumps_until(const std::vector<std::int64_t>& jumps, std::int64_t ticks) {
  return std::upper_bound(jumps.begin(), jumps.end(), ticks) - jumps.begin();
}

}  // namespace orthonav::replay
