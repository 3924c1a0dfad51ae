#pragma once

#include <CLI/App.hpp>
#include <memory>
#include <string>

#include "engine/live/calibrated_headset.h"

namespace orthonav::tools {

/// `--calibration FILE`: the result of `orthonav calibrate stereo` replaces the device's own
/// calibration.
class CalibrationArgument {
 public:
  void add_to(CLI::App& command);
  /// The headset with that calibration, else with the one that its rig file names, else unchanged.
  /// This object owns the new headset and must outlive its use, and so must the original headset.
  Result<Headset*> on(Headset& headset, const std::string& rig_calibration = {});

 private:
  std::string file_;
  std::shared_ptr<engine::CalibratedHeadset> headset_;
};

}  // namespace orthonav::tools
