#pragma once

#include <CLI/App.hpp>
#include <memory>
#include <string>

#include "engine/live/calibrated_headset.h"

namespace orthonav::tools {

/// `--calibration FILE`: what `orthonav calibrate stereo` found takes the place of the device's
/// own.
class CalibrationArgument {
 public:
  void add_to(CLI::App& command);
  /// The headset with that calibration, or as it is where none was named. This owns what is new:
  /// it must outlive its use, and so must the headset.
  Result<Headset*> on(Headset& headset);

 private:
  std::string file_;
  std::shared_ptr<engine::CalibratedHeadset> headset_;
};

}  // namespace orthonav::tools
