#include "hal/sim/cameras/sim_depth.h"

#include <algorithm>
#include <cmath>

namespace orthonav::sim {
namespace {

/// Those of two pairs wait, so that a caller that is late by less than a pair misses none; never
/// more than of half a second, since the room remembers one second.
std::int64_t most_waiting(double rate_hz, double pair_rate_hz) {
  const double waiting_s = std::min(2.0 / pair_rate_hz, 0.5);
  return std::max<std::int64_t>(1, static_cast<std::int64_t>(rate_hz * waiting_s + 1e-6));
}

}  // namespace

SimDepth::SimDepth(SimRoom& room, const SimOptions& options, const DepthModel& model)
    : room_(room),
      rate_hz_(model.rate_hz),
      most_waiting_(most_waiting(model.rate_hz, options.frame_rate_hz)),
      random_(Random(options.seed).fork("depth").fork(name_of(model.stream))),
      renderer_(room.described(), model),
      sensor_(model, options.depth_errors) {}

/// At whole ticks of 100 ns, so that files keep their times.
Timestamp SimDepth::time_of(std::int64_t number) const {
  const double ticks = std::floor(static_cast<double>(number) * 1e7 / rate_hz_ + 0.5);
  return kSimStart + Duration(100 * static_cast<std::int64_t>(ticks));
}

std::int64_t SimDepth::newest() const {
  // Both times are rounded to ticks, so that one on the pair's may seem to lie behind it.
  constexpr double kRounded = 1e-5;
  auto number = static_cast<std::int64_t>(
      std::floor(seconds(room_.last_frame - kSimStart) * rate_hz_ + kRounded));
  while (number > 0 && time_of(number) > room_.last_frame) {
    --number;
  }
  return number;
}

Result<Next> SimDepth::do_next(DepthFrame& frame) {
  {
    const MutexLock lock(room_.mutex);
    const std::int64_t newest = this->newest();
    if (newest <= last_) {
      return room_.ended ? Next::kEnd : Next::kNone;
    }
    last_ = std::max(last_ + 1, newest - most_waiting_ + 1);
    frame.sequence = last_;
    frame.map_epoch = 0;
    frame.time = time_of(last_);
    room_.simulation.state_at(frame.time, state_);
    const auto head = room_.head.at(frame.time);
    frame.world_from_rig.reset();
    if (head.status != PoseStatus::kLost) {
      frame.world_from_rig = head.value;
    }
  }
  renderer_.render(state_, sights_);
  sensor_.measure(renderer_.calibration(), sights_,
                  random_.fork(static_cast<std::uint64_t>(last_)).next(), frame);
  return Next::kFrame;
}

}  // namespace orthonav::sim
