#include "tools/preview/preview_headset.h"

#include "base/wall_clock.h"

namespace orthonav::preview {

Result<Next> PreviewHeadset::GatedCameras::do_next(StereoFrame& frame) {
  if (!gate_.may_pass()) {
    return Next::kNone;
  }
  const Timestamp asked = WallClock().now();
  auto answer = ForwardingCamera::do_next(frame);
  if (!answer || *answer != Next::kFrame) {
    gate_.none_came();
    return answer;
  }
  there_ = WallClock().now();
  camera_ms_ = 1e3 * seconds(there_ - asked);
  gate_.pass(frame.time);
  return answer;
}

double PreviewHeadset::GatedCameras::since_pair_ms() const {
  return 1e3 * seconds(WallClock().now() - there_);
}

}  // namespace orthonav::preview
