#include "hal/fake/scripted.h"

#include <algorithm>
#include <utility>

namespace orthonav::fake {

namespace {

/// What one call gives, and the call after the last.
template <class Frame>
Result<Next> play(const std::vector<std::variant<Frame, Next, Error>>& steps, std::size_t& next,
                  Frame& frame, ManualClock& clock) {
  if (next == steps.size()) {
    return Next::kEnd;
  }
  const auto& step = steps[next++];
  if (const Error* error = std::get_if<Error>(&step)) {
    return *error;
  }
  if (const Next* answer = std::get_if<Next>(&step)) {
    return *answer;
  }
  frame = std::get<Frame>(step);
  clock.set(frame.time);
  return Next::kFrame;
}

}  // namespace

ScriptedCamera::ScriptedCamera(StereoCalibration calibration, std::vector<CameraStep> steps,
                               ManualClock& clock, MayRepeat may_repeat)
    : calibration_(std::move(calibration)),
      steps_(std::move(steps)),
      clock_(clock),
      may_repeat_(may_repeat) {}

Result<Next> ScriptedCamera::do_next(StereoFrame& frame) {
  return play(steps_, next_, frame, clock_);
}

Result<Next> ScriptedToolPoses::do_next(ToolPoses& poses) {
  return play(steps_, next_, poses, clock_);
}

Result<Next> ScriptedDepth::do_next(DepthFrame& frame) {
  if (next_ == script_.steps.size()) {
    return Next::kEnd;
  }
  const DepthStep& step = script_.steps[next_];
  const auto* scripted = std::get_if<DepthFrame>(&step);
  if (scripted && scripted->time > clock_.now()) {
    return Next::kNone;
  }
  ++next_;
  if (const Error* error = std::get_if<Error>(&step)) {
    return *error;
  }
  if (const Next* answer = std::get_if<Next>(&step)) {
    return *answer;
  }
  frame = *scripted;
  return Next::kFrame;
}

ScriptedHead::ScriptedHead(std::vector<HeadPose> poses, const ManualClock& clock)
    : poses_(std::move(poses)), clock_(clock) {}

std::vector<HeadPose>::const_iterator ScriptedHead::known_end() const {
  return std::upper_bound(poses_.begin(), poses_.end(), clock_.now(),
                          [](Timestamp t, const HeadPose& p) { return t < p.time; });
}

std::optional<Timestamp> ScriptedHead::do_newest_measurement() const {
  const auto end = known_end();
  // Before the first pose, every time is too far ahead.
  return end == poses_.begin() ? Timestamp::min() : (end - 1)->time;
}

Tracked<Transform<World, Rig>> ScriptedHead::do_world_from_rig(Timestamp at) const {
  Tracked<Transform<World, Rig>> answer;
  answer.time = at;
  const auto end = known_end();
  const auto after = std::upper_bound(poses_.begin(), end, at,
                                      [](Timestamp t, const HeadPose& p) { return t < p.time; });
  if (after == poses_.begin()) {
    return answer;
  }
  const HeadPose& before = *(after - 1);
  answer.value = before.world_from_rig;
  answer.status =
      after == end && before.time != at ? PoseStatus::kPredicted : PoseStatus::kMeasured;
  if (after != end && before.time != at) {
    answer.value = interpolated(before.world_from_rig, after->world_from_rig,
                                seconds(at - before.time) / seconds(after->time - before.time));
  }
  return answer;
}

Status ScriptedClicker::do_poll(Timestamp until, std::vector<ClickerEvent>& events) {
  while (next_ < events_.size() && events_[next_].time <= until) {
    events.push_back(events_[next_++]);
  }
  return {};
}

Status ScriptedVoice::do_poll(Timestamp until, std::vector<Phrase>& phrases) {
  while (next_ < phrases_.size() && phrases_[next_].time <= until) {
    phrases.push_back(phrases_[next_++]);
  }
  return {};
}

FakeHeadset::FakeHeadset(Script script)
    : epoch_ticks_100ns_(script.epoch_ticks_100ns),
      clock_(script.clock_start),
      cameras_(std::move(script.calibration), std::move(script.camera), clock_, script.may_repeat),
      tool_poses_(std::move(script.tools), std::move(script.tool_poses), clock_),
      head_(std::move(script.head), clock_),
      clicker_(std::move(script.clicker)),
      voice_(std::move(script.voice)),
      display_latency_(script.display_latency) {
  for (DepthScript& depth : script.depth) {
    depth_.push_back(std::make_unique<ScriptedDepth>(std::move(depth), clock_));
  }
}

}  // namespace orthonav::fake
