#include "hal/fake/failing.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

namespace orthonav::fake {

namespace {

template <class Kind>
std::optional<Kind> fault_at(const std::vector<Fault<Kind>>& faults, std::int64_t index) {
  for (const Fault<Kind>& fault : faults) {
    if (fault.at == index) {
      return fault.kind;
    }
  }
  return std::nullopt;
}

template <class To, class From>
Transform<To, From> mirrored(const Transform<To, From>& pose) {
  Mat3 rotation = pose.rotation();
  for (double& entry : rotation[0]) {
    entry = -entry;
  }
  return {rotation, pose.translation()};
}

template <class To, class From>
Transform<To, From> not_a_number(const Transform<To, From>& pose) {
  return {pose.rotation(), {std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0}};
}

void turn_into_garbage(ClickerEvent& event) {
  event.action =
      event.action == ClickerAction::kPress ? ClickerAction::kRelease : ClickerAction::kPress;
}
void turn_into_garbage(Phrase& phrase) { phrase.text.clear(); }

}  // namespace

Result<Next> FailingCamera::do_next(StereoFrame& frame) {
  const auto fault = fault_at(faults_, call_++);
  if (fault == CameraFault::kDelay) {
    return Next::kNone;
  }
  auto answer = ForwardingCamera::do_next(frame);
  if (fault == CameraFault::kDrop && answer && *answer == Next::kFrame) {
    answer = ForwardingCamera::do_next(frame);
  }
  if (!answer || *answer != Next::kFrame) {
    return answer;
  }
  if (fault) {
    answer = spoiled(*fault, frame);
  }
  last_ = frame;
  return answer;
}

Result<Next> FailingCamera::spoiled(CameraFault fault, StereoFrame& frame) {
  const Transform<World, Rig> pose = frame.world_from_rig.value_or(Transform<World, Rig>{});
  switch (fault) {
    case CameraFault::kDrop:
    case CameraFault::kDelay:
      break;  // done before the pair was taken
    case CameraFault::kError:
      return Error{"camera pair: simulated failure"};
    case CameraFault::kWrongSize:
      frame.left = GreyImage(frame.left.width_px, frame.left.height_px - 1);
      break;
    case CameraFault::kShortBuffer:
      frame.right.pixels.pop_back();
      break;
    case CameraFault::kTimeBack:
      frame.time = last_.time;
      break;
    case CameraFault::kSequenceBack:
      frame.sequence = last_.sequence;
      break;
    case CameraFault::kLeftAgain:
      frame.left = last_.left;
      break;
    case CameraFault::kRightAgain:
      frame.right = last_.right;
      break;
    case CameraFault::kPoseAgain:
      frame.world_from_rig = last_.world_from_rig;
      break;
    case CameraFault::kMirroredPose:
      frame.world_from_rig = mirrored(pose);
      break;
    case CameraFault::kNanPose:
      frame.world_from_rig = not_a_number(pose);
      break;
    case CameraFault::kNoPose:
      frame.world_from_rig.reset();
      break;
    case CameraFault::kNoise:
      for (GreyImage* image : {&frame.left, &frame.right}) {
        for (std::uint8_t& pixel : image->pixels) {
          pixel = static_cast<std::uint8_t>(255 - pixel);
        }
      }
      break;
  }
  return Next::kFrame;
}

Result<Next> FailingToolPoses::do_next(ToolPoses& poses) {
  const auto fault = fault_at(faults_, call_++);
  if (fault == ToolPoseFault::kDelay) {
    return Next::kNone;
  }
  auto answer = ForwardingToolPoses::do_next(poses);
  if (fault == ToolPoseFault::kDrop && answer && *answer == Next::kFrame) {
    answer = ForwardingToolPoses::do_next(poses);
  }
  if (!answer || *answer != Next::kFrame || !fault) {
    last_ = poses.time;
    return answer;
  }
  auto& tool = poses.tools.back();
  switch (*fault) {
    case ToolPoseFault::kDrop:
    case ToolPoseFault::kDelay:
      break;  // done before they were taken
    case ToolPoseFault::kError:
      return Error{"tool poses: simulated failure"};
    case ToolPoseFault::kLost:
      tool = {};
      break;
    case ToolPoseFault::kOneLess:
      poses.tools.pop_back();
      break;
    case ToolPoseFault::kPredicted:
      tool.status = PoseStatus::kPredicted;
      break;
    case ToolPoseFault::kOtherTime:
      tool.time += Duration(1);
      break;
    case ToolPoseFault::kTimeBack:
      poses.time = last_;
      break;
    case ToolPoseFault::kMirroredPose:
      tool.value = mirrored(tool.value);
      break;
    case ToolPoseFault::kNanPose:
      tool.value = not_a_number(tool.value);
      break;
    case ToolPoseFault::kNegativeVariance:
      tool.covariance[7] = -1e-12;
      break;
  }
  last_ = poses.time;
  return answer;
}

Tracked<Transform<World, Rig>> FailingHead::do_world_from_rig(Timestamp at) const {
  auto answer = inner_.world_from_rig(at);
  const auto fault = fault_at(faults_, call_++);
  if (!fault) {
    return answer;
  }
  switch (*fault) {
    case HeadFault::kLost:
      answer.status = PoseStatus::kLost;
      break;
    case HeadFault::kWrongTime:
      answer.time = at - std::chrono::milliseconds(33);
      break;
    case HeadFault::kNanPose:
      answer.value = not_a_number(answer.value);
      break;
    case HeadFault::kMirroredPose:
      answer.value = mirrored(answer.value);
      break;
    case HeadFault::kNanCovariance:
      answer.covariance[0] = std::numeric_limits<double>::quiet_NaN();
      break;
  }
  return answer;
}

template <class Device, class Event>
Status FailingEvents<Device, Event>::do_poll(Timestamp until, std::vector<Event>& events) {
  if (Status status = inner_.poll(until, waiting_); !status) {
    return status;
  }
  std::size_t taken = 0;
  for (; taken < waiting_.size(); ++taken) {
    const std::int64_t index = delivered_ + static_cast<std::int64_t>(taken);
    auto fault = fault_at(faults_, index);
    if (fault == EventFault::kDelay || fault == EventFault::kError) {
      const bool spent = index <= spent_;
      spent_ = std::max(spent_, index);
      if (!spent && fault == EventFault::kError) {
        return Error{"simulated failure"};
      }
      if (!spent) {
        break;
      }
    }
    if (fault == EventFault::kDrop) {
      continue;
    }
    Event event = waiting_[taken];
    if (fault == EventFault::kTimeBack) {
      event.time -= std::chrono::hours(1);
    }
    if (fault == EventFault::kFuture) {
      event.time = until + std::chrono::seconds(1);
    }
    if (fault == EventFault::kGarbage) {
      turn_into_garbage(event);
    }
    events.push_back(event);
    if (fault == EventFault::kRepeat) {
      events.push_back(event);
    }
  }
  waiting_.erase(waiting_.begin(), waiting_.begin() + static_cast<std::ptrdiff_t>(taken));
  delivered_ += static_cast<std::int64_t>(taken);
  return {};
}

template class FailingEvents<Clicker, ClickerEvent>;
template class FailingEvents<Voice, Phrase>;

FailingHeadset::FailingHeadset(Headset& inner, Faults faults)
    : ForwardingHeadset(inner),
      head_(inner.head(), std::move(faults.head)),
      clicker_(inner.clicker(), std::move(faults.clicker)),
      voice_(inner.voice(), std::move(faults.voice)) {
  if (StereoCamera* cameras = inner.cameras()) {
    cameras_.emplace(*cameras, std::move(faults.camera));
  }
  if (ToolPoseSource* poses = inner.tool_poses()) {
    tool_poses_.emplace(*poses, std::move(faults.tool_poses));
  }
}

}  // namespace orthonav::fake
