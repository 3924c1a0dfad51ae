#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "engine/case/operation.h"
#include "engine/report/registration_figures.h"
#include "tools/orthonav/shared/common_error_arguments.h"

namespace orthonav::tools {

struct RegisterArguments {
  std::string model;
  std::string points;
  std::string units;  ///< empty: as stated by the files, or else mm
  std::string frame;  ///< empty: as stated by the files, or else LPS
  std::vector<std::string> plans;
  std::string case_folder;
  std::string level;  ///< of the case; with neither a folder nor a model, of the built-in phantom
  std::string method = "best";
  std::optional<double> model_sd_mm;
  bool any_bone = false;  ///< the model may be of another bone than a vertebra
  double tip_radius_mm = 0.0;
  CommonErrorArguments common;
};

/// The points and the level to be registered.
struct RegisterInputs {
  engine::OperatedLevel level;  ///< its label is empty if no case names it
  std::vector<Point<World>> points;
  engine::FigureFrame frame;
  std::optional<engine::Axes> points_axes;  ///< if the points' file states its axes
};

/// Reads and checks every file that the arguments name. `check_points` may refuse once the points
/// are read, before the model is prepared.
Result<RegisterInputs> load_register_inputs(
    const RegisterArguments& arguments,
    const std::function<Status(const RegisterInputs&)>& check_points);

}  // namespace orthonav::tools
