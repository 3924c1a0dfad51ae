#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hal/api/forwarding_headset.h"

namespace orthonav::fake {

/// A fault and the call (or event) at which it occurs, counted from 0.
template <class Kind>
struct Fault {
  std::int64_t at = 0;
  Kind kind{};
};

enum class CameraFault {
  kDrop,          ///< this pair is lost, and the next one comes instead
  kDelay,         ///< kNone now; the pair comes with the next call
  kError,         ///< an Error, and the pair is lost
  kWrongSize,     ///< the left image is one line short
  kShortBuffer,   ///< the right image holds fewer bytes than its size requires
  kTimeBack,      ///< stamped like the pair before it
  kSequenceBack,  ///< numbered like the pair before it
  kLeftAgain,     ///< with the left image of the pair before it
  kRightAgain,    ///< with the right image of the pair before it
  kPoseAgain,     ///< with the head's pose of the pair before it
  kMirroredPose,
  kNanPose,
  kNoPose,  ///< the head is not located: allowed
  kNoise    ///< every pixel inverted: allowed, since it can't be detected
};
enum class ToolPoseFault {
  kDrop,   ///< these poses are lost, and the next ones come instead
  kDelay,  ///< kNone now; they come with the next call
  kError,  ///< an Error, and they are lost
  kLost,   ///< the last tool is out of sight: allowed
  kOneLess,
  kPredicted,
  kOtherTime,
  kTimeBack,  ///< stamped like those before
  kMirroredPose,
  kNanPose,
  kNegativeVariance
};
enum class HeadFault { kLost, kWrongTime, kNanPose, kMirroredPose, kNanCovariance };
enum class EventFault {
  kDrop,      ///< this event is lost
  kDelay,     ///< this event and the following ones come with the next poll
  kError,     ///< an Error; the due events come with the next poll
  kTimeBack,  ///< stamped an hour early
  kFuture,    ///< stamped a second after the time asked for
  kRepeat,    ///< delivered twice
  kGarbage    ///< the clicker's opposite action; a phrase without text
};

/// Passes on a camera pair except for its faults; `at` counts the calls of next().
class FailingCamera : public ForwardingCamera {
 public:
  FailingCamera(StereoCamera& inner, std::vector<Fault<CameraFault>> faults)
      : ForwardingCamera(inner), faults_(std::move(faults)) {}

 private:
  std::vector<Fault<CameraFault>> faults_;
  std::int64_t call_ = 0;
  StereoFrame last_;  ///< as passed on

  /// There is nothing to see before `next`, which makes the faults.
  bool do_tap(PairTap* /*tap*/) override { return false; }
  Result<Next> do_next(StereoFrame& frame) override;
  Result<Next> spoiled(CameraFault fault, StereoFrame& frame);
};

/// Likewise for poses of tools.
class FailingToolPoses : public ForwardingToolPoses {
 public:
  FailingToolPoses(ToolPoseSource& inner, std::vector<Fault<ToolPoseFault>> faults)
      : ForwardingToolPoses(inner), faults_(std::move(faults)) {}

 private:
  std::vector<Fault<ToolPoseFault>> faults_;
  std::int64_t call_ = 0;
  Timestamp last_{};  ///< as passed on

  Result<Next> do_next(ToolPoses& poses) override;
};

/// `at` counts the calls.
class FailingHead : public HeadTracker {
 public:
  FailingHead(const HeadTracker& inner, std::vector<Fault<HeadFault>> faults)
      : inner_(inner), faults_(std::move(faults)) {}

 private:
  const HeadTracker& inner_;
  std::vector<Fault<HeadFault>> faults_;
  mutable std::atomic<std::int64_t> call_{0};

  [[nodiscard]] Tracked<Transform<World, Rig>> do_world_from_rig(Timestamp at) const override;
};

/// Clicker or voice; `at` counts the events.
template <class Device, class Event>
class FailingEvents : public Device {
 public:
  FailingEvents(Device& inner, std::vector<Fault<EventFault>> faults)
      : inner_(inner), faults_(std::move(faults)) {}

 private:
  Device& inner_;
  std::vector<Fault<EventFault>> faults_;
  std::vector<Event> waiting_;
  std::int64_t delivered_ = 0;
  std::int64_t spent_ = -1;  // the last event already held back by a delay or an error

  Status do_poll(Timestamp until, std::vector<Event>& events) override;
};
using FailingClicker = FailingEvents<Clicker, ClickerEvent>;
using FailingVoice = FailingEvents<Voice, Phrase>;

struct Faults {
  std::vector<Fault<CameraFault>> camera{};
  std::vector<Fault<ToolPoseFault>> tool_poses{};
  std::vector<Fault<HeadFault>> head{};
  std::vector<Fault<EventFault>> clicker{};
  std::vector<Fault<EventFault>> voice{};
};

/// A headset with faults. The inner one is borrowed.
class FailingHeadset : public ForwardingHeadset {
 public:
  FailingHeadset(Headset& inner, Faults faults);
  [[nodiscard]] std::string name() const override { return "failing " + ForwardingHeadset::name(); }
  [[nodiscard]] StereoCamera* cameras() override { return cameras_ ? &*cameras_ : nullptr; }
  [[nodiscard]] ToolPoseSource* tool_poses() override {
    return tool_poses_ ? &*tool_poses_ : nullptr;
  }
  [[nodiscard]] HeadTracker& head() override { return head_; }
  [[nodiscard]] Clicker& clicker() override { return clicker_; }
  [[nodiscard]] Voice& voice() override { return voice_; }

 private:
  std::optional<FailingCamera> cameras_;
  std::optional<FailingToolPoses> tool_poses_;
  FailingHead head_;
  FailingClicker clicker_;
  FailingVoice voice_;
};

}  // namespace orthonav::fake
