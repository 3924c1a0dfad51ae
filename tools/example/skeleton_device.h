#pragma once

#include <orthonav/hal/api/devices.h>
#include <orthonav/hal/api/headset_scheme.h>
#include <memory>
#include <string>

#include "must.h"

namespace mine {

using namespace orthonav;

/// A minimal headset. It shows an empty room at 30 pairs a second for as many pairs as its URI
/// says: "skeleton:90".
class SkeletonDevice : public Headset, Clock, StereoCamera, HeadTracker, Clicker, Voice {
 public:
  SkeletonDevice(StereoCalibration calibration, int pairs)
      : calibration_(std::move(calibration)), pairs_(pairs) {}
  [[nodiscard]] std::string name() const override { return "skeleton"; }
  [[nodiscard]] const Clock& clock() const override { return *this; }
  [[nodiscard]] StereoCamera* cameras() override { return this; }
  [[nodiscard]] HeadTracker& head() override { return *this; }
  [[nodiscard]] Clicker& clicker() override { return *this; }
  [[nodiscard]] Voice& voice() override { return *this; }
  [[nodiscard]] Duration display_latency() const override { return std::chrono::milliseconds(16); }

 private:
  /// Into the buffer that the frame has already.
  static void fill(GreyImage& image, const CameraModel& camera) {
    image.width_px = camera.width_px();
    image.height_px = camera.height_px();
    image.pixels.assign(static_cast<std::size_t>(image.width_px) * image.height_px, 0);
  }
  [[nodiscard]] Timestamp now() const override {
    return Timestamp{} + next_ * std::chrono::microseconds(33333);
  }
  [[nodiscard]] const StereoCalibration& do_calibration() const override { return calibration_; }
  /// It has no sensors. A real device leaves this out: what repeats there is old.
  [[nodiscard]] MayRepeat do_may_repeat() const override { return {true, true}; }
  Result<Next> do_next(StereoFrame& frame) override {
    if (next_ == pairs_) {
      return Next::kEnd;
    }
    frame.sequence = next_++;
    frame.time = now();
    fill(frame.left, calibration_.left);
    fill(frame.right, calibration_.right);
    frame.world_from_rig = Transform<World, Rig>{};
    return Next::kFrame;
  }
  [[nodiscard]] Tracked<Transform<World, Rig>> do_world_from_rig(Timestamp at) const override {
    return {{}, at, at <= now() ? PoseStatus::kMeasured : PoseStatus::kPredicted};
  }
  /// After it, a pose is predicted for a short time; then the head is lost.
  [[nodiscard]] std::optional<Timestamp> do_newest_measurement() const override { return now(); }
  Status do_poll(Timestamp, std::vector<ClickerEvent>&) override { return {}; }
  Status do_poll(Timestamp, std::vector<Phrase>&) override { return {}; }

  StereoCalibration calibration_;
  int pairs_;
  int next_ = 0;
};

/// Cameras without distortion; a real device reads its own.
inline StereoCalibration calibration() {
  const CameraModel camera = must(CameraModel::from_brown_conrady({640, 480, 450, 450, 320, 240}));
  return {camera, camera, {}, {Mat3::identity(), {-0.1, 0, 0}}};
}

/// It listens for no phrases.
inline Result<OpenedDevice> open_skeleton(const std::string& pairs,
                                          const std::vector<std::string>& /*phrases*/) {
  return OpenedDevice{std::make_unique<SkeletonDevice>(calibration(), std::atoi(pairs.c_str())),
                      {}};
}

}  // namespace mine
