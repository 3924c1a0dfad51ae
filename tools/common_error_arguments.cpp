#include "tools/common_error_arguments.h"

#include "tools/arguments.h"

namespace orthonav::tools {

void CommonErrorArguments::add_to(CLI::App& command) {
  constexpr double kLargest_mm = 10.0;
  const auto add = [&command](const char* name, double& sd_mm, const char* text) {
    command.add_option(name, sd_mm, text)
        ->check(finite_number(0, kLargest_mm))
        ->capture_default_str();
  };
  add("--tip-sd-mm", tip_sd_mm,
      "SD along an axis of what all strokes share: the error of the pointer's tip");
  add("--cameras-sd-mm", cameras_sd_mm, "the same of the cameras' calibration");
  add("--map-sd-mm", map_sd_mm, "the same of the map's drift since the bone was stroked");
}

}  // namespace orthonav::tools
