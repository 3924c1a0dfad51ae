#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "study/simulated_operation.h"
#include "tools/orthonav/operation/kept_operation.h"
#include "tools/orthonav/operation/limit_arguments.h"
#include "tools/orthonav/operation/onlookers.h"
#include "tools/orthonav/operation/wearer_arguments.h"
#include "tools/orthonav/shared/arguments.h"
#include "tools/orthonav/shared/calibration_argument.h"
#include "tools/orthonav/shared/set_up_arguments.h"

namespace orthonav::tools {

/// The arguments of `orthonav demo`.
struct DemoArguments {
  std::string case_folder;
  std::uint64_t seed = 1;
  std::string out = "orthonav-demo";
  std::vector<std::string> levels;
  std::string record;
  std::string beside;  ///< folder of another run's results; empty: none
  std::string device;
  bool realtime = false;
  bool fast = false;
  bool perfect = false;
  bool resume = false;
  bool no_video = false;
  bool json = false;
  int threads = 2;
  std::optional<double> pace;
  RodsOnlyArguments rods;
  SetUpArguments set_up;
  CalibrationArgument calibration;
  WearerArguments wearer;
  LimitArguments limits;
  OnlookerArguments onlookers;
};

/// Adds the options that fill them in.
void add_demo_arguments(CLI::App& demo, DemoArguments& arguments);
/// Refuses an unknown instrument.
[[nodiscard]] Result<engine::OperationOptions> options_of(const DemoArguments& arguments);
/// For the log of the operation.
[[nodiscard]] KeptOperation::About about_demo(const DemoArguments& arguments,
                                              const std::string& case_name);

}  // namespace orthonav::tools
