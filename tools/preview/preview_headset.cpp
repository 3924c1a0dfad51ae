#include "tools/preview/preview_headset.h"

#include "base/wall_clock.h"

namespace orthonav::preview {

template <class Forwarding, class Frame>
Result<Next> PreviewHeadset::Gated<Forwarding, Frame>::do_next(Frame& frame) {
  if (!passage_.gate.may_pass()) {
    return Next::kNone;
  }
  const Timestamp asked = WallClock().now();
  auto answer = Forwarding::do_next(frame);
  if (!answer || *answer != Next::kFrame) {
    passage_.gate.none_came();
    return answer;
  }
  passage_.there = WallClock().now();
  passage_.camera_ms = 1e3 * seconds(passage_.there - asked);
  passage_.gate.pass(frame.time);
  return answer;
}

template class PreviewHeadset::Gated<ForwardingCamera, StereoFrame>;
template class PreviewHeadset::Gated<ForwardingToolPoses, ToolPoses>;

double PreviewHeadset::since_pair_ms() const {
  return 1e3 * seconds(WallClock().now() - passage_.there);
}

}  // namespace orthonav::preview
