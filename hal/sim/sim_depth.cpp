#include "hal/sim/sim_depth.h"

#include <cmath>

namespace orthonav::sim {

SimDepth::SimDepth(SimRoom& room, const SimOptions& options, const DepthModel& model)
    : room_(room),
      rate_hz_(model.rate_hz),
      random_(Random(options.seed).fork("depth").fork(name_of(model.stream))),
      renderer_(room.described(), model),
      sensor_(model, options.depth_errors) {}

/// At whole ticks of 100 ns, so that files keep their times.
Timestamp SimDepth::time_of(std::int64_t number) const {
  const double ticks = std::floor(static_cast<double>(number) * 1e7 / rate_hz_ + 0.5);
  return kSimStart + Duration(100 * static_cast<std::int64_t>(ticks));
}

Result<Next> SimDepth::do_next(DepthFrame& frame) {
  {
    const MutexLock lock(room_.mutex);
    // The room is known up to the last pair.
    auto newest = static_cast<std::int64_t>(
        std::floor(seconds(room_.last_frame - kSimStart) * rate_hz_ + 1e-6));
    while (newest > 0 && time_of(newest) > room_.last_frame) {
      --newest;
    }
    if (newest <= last_) {
      return room_.ended ? Next::kEnd : Next::kNone;
    }
    last_ = newest;
    frame.sequence = newest;
    frame.map_epoch = 0;
    frame.time = time_of(newest);
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
