// Gives orthonav a device from outside, opens it by its URI and runs an operation on it.
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "engine/case/operation_plan.h"
#include "engine/case/tool_file.h"
#include "engine/live/assembled_operation.h"
#include "engine/phantom/phantom.h"
#include "hal/api/devices.h"
#include "hal/open/open.h"

using namespace orthonav;

/// The least that a headset must do. It shows an empty room at 30 pairs a second for as many pairs
/// as its URI says: "skeleton:90".
class SkeletonDevice : public Headset, Clock, StereoCamera, HeadTracker, Clicker, Voice, Display {
 public:
  SkeletonDevice(StereoCalibration calibration, int pairs)
      : calibration_(std::move(calibration)), pairs_(pairs) {}
  [[nodiscard]] std::string name() const override { return "skeleton"; }
  [[nodiscard]] const Clock& clock() const override { return *this; }
  [[nodiscard]] StereoCamera& cameras() override { return *this; }
  [[nodiscard]] HeadTracker& head() override { return *this; }
  [[nodiscard]] Clicker& clicker() override { return *this; }
  [[nodiscard]] Voice& voice() override { return *this; }
  [[nodiscard]] Display& display() override { return *this; }

 private:
  [[nodiscard]] Timestamp now() const override {
    return Timestamp{} + next_ * std::chrono::microseconds(33333);
  }
  [[nodiscard]] const StereoCalibration& do_calibration() const override { return calibration_; }
  Result<Next> do_next(StereoFrame& frame) override {
    if (next_ == pairs_) {
      return Next::kEnd;
    }
    frame.sequence = next_++;
    frame.time = now();
    frame.left = {calibration_.left.width_px(), calibration_.left.height_px()};
    frame.right = {calibration_.right.width_px(), calibration_.right.height_px()};
    frame.world_from_rig = Transform<World, Rig>{};
    return Next::kFrame;
  }
  [[nodiscard]] Tracked<Transform<World, Rig>> do_world_from_rig(Timestamp at) const override {
    return {{}, at, at <= now() ? PoseStatus::kMeasured : PoseStatus::kPredicted};
  }
  Status do_poll(Timestamp, std::vector<ClickerEvent>&) override { return {}; }
  Status do_poll(Timestamp, std::vector<Phrase>&) override { return {}; }
  [[nodiscard]] Duration do_latency() const override { return std::chrono::milliseconds(16); }
  Status do_shown(const ShownFrame&) override { return {}; }

  StereoCalibration calibration_;
  int pairs_;
  int next_ = 0;
};

/// A camera without distortion; a real device reads its own.
Result<StereoCalibration> calibration() {
  const auto camera = CameraModel::from_brown_conrady({640, 480, 450, 450, 320, 240});
  if (!camera) {
    return camera.error();
  }
  StereoCalibration both{*camera, *camera, {}, {}};
  both.right_from_rig = Transform<RightCamera, Rig>(Mat3::identity(), {-0.1, 0, 0});
  return both;
}

Result<std::unique_ptr<Headset>> open_skeleton(const std::string& pairs) {
  auto cameras = calibration();
  if (!cameras) {
    return cameras.error();
  }
  return std::unique_ptr<Headset>(
      std::make_unique<SkeletonDevice>(std::move(*cameras), std::atoi(pairs.c_str())));
}

int main(int argc, char** argv) {
  const Status known = register_scheme({"skeleton", "skeleton:PAIRS", nullptr, open_skeleton});
  auto headset = known ? open_headset(argc > 1 ? argv[1] : "skeleton:30")
                       : Result<std::unique_ptr<Headset>>(known.error());
  auto operation = engine::plan_operation(engine::phantom(), {"L4"});
  auto method = engine::method_named("best");
  if (!headset || !operation || !method) {
    std::fprintf(stderr, "device: %s\n",
                 headset ? "no operation" : headset.error().message.c_str());
    return 2;
  }
  auto assembled = engine::assemble_operation(**headset, std::move(*operation), *method,
                                              engine::built_in_tools());
  auto report = assembled ? (*assembled)->run() : Result<engine::LoopReport>(assembled.error());
  if (!report) {
    std::fprintf(stderr, "device: %s\n", report.error().message.c_str());
    return 2;
  }
  std::printf("%s: %lld frames shown\n", (*headset)->name().c_str(),
              static_cast<long long>(report->displayed));
}
