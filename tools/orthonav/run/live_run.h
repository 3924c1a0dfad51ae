#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tools/orthonav/operation/limit_arguments.h"
#include "tools/orthonav/operation/onlookers.h"
#include "tools/orthonav/operation/wearer_arguments.h"
#include "tools/orthonav/shared/arguments.h"
#include "tools/orthonav/shared/calibration_argument.h"
#include "tools/orthonav/shared/common_error_arguments.h"
#include "tools/orthonav/shared/screw_arguments.h"
#include "tools/orthonav/shared/set_up_arguments.h"
#include "tools/orthonav/shared/stop_signals.h"

namespace orthonav::tools {

/// The arguments of `orthonav run`.
struct RunArguments {
  std::string headset = "sim:";
  std::string case_folder;
  std::vector<std::string> levels;
  std::string tools_file;
  std::string clicker = "headset";
  std::string voice = "headset";
  std::string record;
  std::string out;
  RodsOnlyArguments rods;
  CommonErrorArguments common;
  ScrewArguments screws;
  CalibrationArgument calibration;
  LimitArguments limits;
  OnlookerArguments onlookers;
  WearerArguments wearer;
  std::int64_t frames = 0;
  double for_s = 0.0;  ///< of the device's clock; 0: no limit
  SetUpArguments set_up;
  bool resume = false;
  bool json = false;
  bool stats = false;
};

/// Runs an operation on the given headset, from opening it to writing the results. Returns the exit
/// code.
int run_live(const RunArguments& arguments, StopSignals& signals);

}  // namespace orthonav::tools
