#pragma once

#include "hal/api/devices.h"
#include "hal/api/tool_pose_source.h"

namespace orthonav {

/// Forwards to another camera pair; a base class for those that change or watch some of it. Borrows
/// the other pair. One that changes what `next` returns must change what a tap sees as well, or
/// refuse the tap.
class ForwardingCamera : public StereoCamera {
 public:
  explicit ForwardingCamera(StereoCamera& inner) : inner_(inner) {}

 protected:
  [[nodiscard]] const StereoCalibration& do_calibration() const override {
    return inner_.calibration();
  }
  bool do_tap(PairTap* tap) override { return inner_.tap(tap); }
  [[nodiscard]] MayRepeat do_may_repeat() const override { return inner_.may_repeat(); }
  Result<Next> do_next(StereoFrame& frame) override { return inner_.next(frame); }

 private:
  StereoCamera& inner_;
};

/// Likewise for poses of tools.
class ForwardingToolPoses : public ToolPoseSource {
 public:
  explicit ForwardingToolPoses(ToolPoseSource& inner) : inner_(inner) {}

 protected:
  [[nodiscard]] std::span<const std::string> do_names() const override { return inner_.names(); }
  Result<Next> do_next(ToolPoses& poses) override { return inner_.next(poses); }

 private:
  ToolPoseSource& inner_;
};

/// Forwards to another headset, part by part; a base class for headsets that replace some parts.
/// Borrows the other headset.
class ForwardingHeadset : public Headset {
 public:
  explicit ForwardingHeadset(Headset& inner) : inner_(inner) {}
  [[nodiscard]] std::string name() const override { return inner_.name(); }
  [[nodiscard]] const Clock& clock() const override { return inner_.clock(); }
  [[nodiscard]] std::int64_t epoch_ticks_100ns() const override {
    return inner_.epoch_ticks_100ns();
  }
  [[nodiscard]] StereoCamera* cameras() override { return inner_.cameras(); }
  [[nodiscard]] ToolPoseSource* tool_poses() override { return inner_.tool_poses(); }
  [[nodiscard]] HeadTracker& head() override { return inner_.head(); }
  [[nodiscard]] Clicker& clicker() override { return inner_.clicker(); }
  [[nodiscard]] Voice& voice() override { return inner_.voice(); }
  [[nodiscard]] Duration display_latency() const override { return inner_.display_latency(); }
  [[nodiscard]] std::vector<DepthCamera*> depth_cameras() override {
    return inner_.depth_cameras();
  }
  [[nodiscard]] Microphone* microphone() override { return inner_.microphone(); }
  [[nodiscard]] PixelDisplay* pixels() override { return inner_.pixels(); }
  [[nodiscard]] ObjectDisplay* objects() override { return inner_.objects(); }
  [[nodiscard]] Wearer* wearer() override { return inner_.wearer(); }
  [[nodiscard]] DescribedTools described_tools() const override { return inner_.described_tools(); }
  [[nodiscard]] std::optional<ConnectionStatistics> connection() const override {
    return inner_.connection();
  }

 private:
  Headset& inner_;
};

}  // namespace orthonav
