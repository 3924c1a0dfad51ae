#include "hal/replay/replay_depth.h"

namespace orthonav::replay {

Result<Next> ReplayDepth::do_next(DepthFrame& frame) {
  if (next_ == depth_.frames.size()) {
    return Next::kEnd;
  }
  if (!due()) {
    return Next::kNone;
  }
  const RecordedDepthFrame& recorded = depth_.frames[next_++];
  if (Status s = depth_.read(recorded, frame); !s) {
    return s.error();
  }
  progress_.advance_to(recorded.clock);
  return Next::kFrame;
}

/// Whether the next frame is due; in real time the newest due frame becomes the next one.
bool ReplayDepth::due() {
  const auto& frames = depth_.frames;
  const Timestamp now = clock_.now();
  if (pace_ != ReplayPace::kRealtime) {
    return frames[next_].clock <= now || progress_.pairs_over;
  }
  if (frames[next_].clock > now) {
    return false;
  }
  while (next_ + 1 < frames.size() && frames[next_ + 1].clock <= now) {
    ++next_;
  }
  return true;
}

}  // namespace orthonav::replay
