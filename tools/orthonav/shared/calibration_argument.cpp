#include "tools/orthonav/shared/calibration_argument.h"

#include "engine/live/camera_files.h"
#include "tools/orthonav/shared/arguments.h"

namespace orthonav::tools {

void CalibrationArgument::add_to(CLI::App& command) {
  command
      .add_option(
          "--calibration", file_,
          "cameras as orthonav calibrate stereo, Kalibr, OpenCV or ROS (LEFT,RIGHT) found them "
          "(default: as the device says)")
      ->check(some_text())
      ->type_name("FILE");
}

Result<Headset*> CalibrationArgument::on(Headset& headset, const std::string& rig_calibration) {
  const std::string& path = file_.empty() ? rig_calibration : file_;
  if (path.empty()) {
    return &headset;
  }
  const auto file = engine::load_cameras(path);
  if (!file) {
    return file.error();
  }
  auto calibrated = engine::CalibratedHeadset::create(headset, *file);
  if (!calibrated) {
    return calibrated.error();
  }
  headset_ = std::move(*calibrated);
  return headset_.get();
}

}  // namespace orthonav::tools
