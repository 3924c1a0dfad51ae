#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "hal/api/depth_camera.h"
#include "hal/api/devices.h"
#include "hal/api/tool_pose_source.h"

namespace orthonav::fake {

/// A clock that stands still until it is set. Thread-safe.
class ManualClock : public Clock {
 public:
  explicit ManualClock(Timestamp start = Timestamp{}) : now_(start) {}
  [[nodiscard]] Timestamp now() const override { return now_.load(); }
  [[nodiscard]] bool runs_by_itself() const override { return false; }
  void set(Timestamp now) { now_ = now; }
  void advance(Duration by) { now_ = now_.load() + by; }

 private:
  std::atomic<Timestamp> now_;
};

/// The result of one call of next(): a pair, nothing, or a failure.
using CameraStep = std::variant<StereoFrame, Next, Error>;

/// Plays its steps, one per call, then ends. A delivered pair sets the clock to its time.
class ScriptedCamera : public StereoCamera {
 public:
  ScriptedCamera(StereoCalibration calibration, std::vector<CameraStep> steps, ManualClock& clock,
                 MayRepeat may_repeat);

 private:
  StereoCalibration calibration_;
  std::vector<CameraStep> steps_;
  std::size_t next_ = 0;
  ManualClock& clock_;
  MayRepeat may_repeat_;

  [[nodiscard]] const StereoCalibration& do_calibration() const override { return calibration_; }
  [[nodiscard]] MayRepeat do_may_repeat() const override { return may_repeat_; }
  Result<Next> do_next(StereoFrame& frame) override;
};

/// Likewise for poses of tools.
using ToolPoseStep = std::variant<ToolPoses, Next, Error>;

/// Plays its steps, one per call, then ends. Delivered poses set the clock to their time.
class ScriptedToolPoses : public ToolPoseSource {
 public:
  ScriptedToolPoses(std::vector<std::string> names, std::vector<ToolPoseStep> steps,
                    ManualClock& clock)
      : names_(std::move(names)), steps_(std::move(steps)), clock_(clock) {}

 private:
  std::vector<std::string> names_;
  std::vector<ToolPoseStep> steps_;
  std::size_t next_ = 0;
  ManualClock& clock_;

  [[nodiscard]] std::span<const std::string> do_names() const override { return names_; }
  Result<Next> do_next(ToolPoses& poses) override;
};

using DepthStep = std::variant<DepthFrame, Next, Error>;

/// A depth camera and what its calls will do; a frame waits until the clock has reached its time.
struct DepthScript {
  DepthCalibration calibration;
  std::vector<DepthStep> steps;
};

/// Plays its steps, one per call, then ends.
class ScriptedDepth : public DepthCamera {
 public:
  ScriptedDepth(DepthScript script, const ManualClock& clock)
      : script_(std::move(script)), clock_(clock) {}

 private:
  DepthScript script_;
  std::size_t next_ = 0;
  const ManualClock& clock_;

  [[nodiscard]] const DepthCalibration& do_calibration() const override {
    return script_.calibration;
  }
  Result<Next> do_next(DepthFrame& frame) override;
};

struct HeadPose {
  Timestamp time{};
  Transform<World, Rig> world_from_rig;
};

/// Knows the poses up to the clock's time: measured at and between them; beyond the newest, it
/// predicts no motion.
class ScriptedHead : public HeadTracker {
 public:
  /// `poses` strictly increase in time.
  ScriptedHead(std::vector<HeadPose> poses, const ManualClock& clock);

 private:
  std::vector<HeadPose> poses_;
  const ManualClock& clock_;

  [[nodiscard]] Tracked<Transform<World, Rig>> do_world_from_rig(Timestamp at) const override;
  [[nodiscard]] std::optional<Timestamp> do_newest_measurement() const override;
  [[nodiscard]] std::vector<HeadPose>::const_iterator known_end() const;
};

/// Delivers its events in the order given, each once its time is asked for.
class ScriptedClicker : public Clicker {
 public:
  explicit ScriptedClicker(std::vector<ClickerEvent> events) : events_(std::move(events)) {}

 private:
  std::vector<ClickerEvent> events_;
  std::size_t next_ = 0;

  Status do_poll(Timestamp until, std::vector<ClickerEvent>& events) override;
};

class ScriptedVoice : public Voice {
 public:
  explicit ScriptedVoice(std::vector<Phrase> phrases) : phrases_(std::move(phrases)) {}

 private:
  std::vector<Phrase> phrases_;
  std::size_t next_ = 0;

  Status do_poll(Timestamp until, std::vector<Phrase>& phrases) override;
};

/// Everything a scripted headset will ever do.
struct Script {
  StereoCalibration calibration;
  std::vector<CameraStep> camera;
  std::vector<DepthScript> depth;
  /// Named: it measures them itself and has no cameras.
  std::vector<std::string> tools;
  std::vector<ToolPoseStep> tool_poses;
  std::vector<HeadPose> head;
  std::vector<ClickerEvent> clicker;
  std::vector<Phrase> voice;
  Duration display_latency{};
  Timestamp clock_start{};
  std::int64_t epoch_ticks_100ns = 0;
  /// No sensor: most scripts show the same picture all the time.
  MayRepeat may_repeat{true, true};
};

class FakeHeadset : public Headset {
 public:
  explicit FakeHeadset(Script script);
  [[nodiscard]] std::string name() const override { return "fake"; }
  [[nodiscard]] const Clock& clock() const override { return clock_; }
  [[nodiscard]] std::int64_t epoch_ticks_100ns() const override { return epoch_ticks_100ns_; }
  [[nodiscard]] StereoCamera* cameras() override { return measures_tools() ? nullptr : &cameras_; }
  [[nodiscard]] ToolPoseSource* tool_poses() override {
    return measures_tools() ? &tool_poses_ : nullptr;
  }
  [[nodiscard]] HeadTracker& head() override { return head_; }
  [[nodiscard]] Clicker& clicker() override { return clicker_; }
  [[nodiscard]] Voice& voice() override { return voice_; }
  [[nodiscard]] Duration display_latency() const override { return display_latency_; }
  [[nodiscard]] std::vector<DepthCamera*> depth_cameras() override { return borrowed(depth_); }
  [[nodiscard]] ManualClock& manual_clock() { return clock_; }

 private:
  [[nodiscard]] bool measures_tools() const { return !tool_poses_.names().empty(); }

  std::int64_t epoch_ticks_100ns_;
  ManualClock clock_;
  ScriptedCamera cameras_;
  ScriptedToolPoses tool_poses_;
  std::vector<std::unique_ptr<ScriptedDepth>> depth_;
  ScriptedHead head_;
  ScriptedClicker clicker_;
  ScriptedVoice voice_;
  Duration display_latency_;
};

}  // namespace orthonav::fake
