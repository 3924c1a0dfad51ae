// Gives orthonav a device from outside, opens it by its URI and runs an operation on it.
#include <cstdio>
#include <cstdlib>
#include <memory>

#include "engine/case/operation_plan.h"
#include "engine/case/tool_file.h"
#include "engine/live/assembled_operation.h"
#include "engine/phantom/phantom.h"
#include "hal/open/open.h"
#include "skeleton_device.h"

using namespace orthonav;

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
