#include "hal/hl2ss/arrival_meter.h"

#include <algorithm>
#include <cmath>

namespace orthonav::hl2ss {

void ArrivalMeter::heard(Timestamp stamp, HostTime at) {
  ++statistics_.packets;
  if (last_) {
    const Duration between = stamp - last_->stamp;
    if (2 * between > 3 * interval_) {
      ++statistics_.gaps;
    }
    statistics_.longest_gap = std::max(statistics_.longest_gap, between);
    const double deviation_ms =
        std::abs(seconds(std::chrono::duration_cast<Duration>(at - last_->at) - between)) * 1e3;
    statistics_.jitter_ms += (deviation_ms - statistics_.jitter_ms) / 16.0;
  }
  last_ = Arrival{stamp, at};
}

}  // namespace orthonav::hl2ss
