#include "tools/orthonav/shared/common_error_arguments.h"

#include "tools/orthonav/shared/arguments.h"

namespace orthonav::tools {

void CommonErrorArguments::add_to(CLI::App& command, const Otherwise& otherwise) {
  constexpr double kLargest_mm = 10.0;
  const auto add = [&](const char* name, std::optional<double>& sd_mm, const std::string& text,
                       const std::string& without) {
    command.add_option(name, sd_mm, text + " (default: " + without + ")")
        ->check(finite_number(0, kLargest_mm));
  };
  add("--tip-sd-mm", tip_sd_mm,
      "SD along an axis of what all strokes share: the error of the pointer's tip", otherwise.tip);
  add("--cameras-sd-mm", cameras_sd_mm, "the same of the cameras' calibration", otherwise.cameras);
  add("--map-sd-mm", map_sd_mm, "the same of the map's drift since the bone was stroked",
      otherwise.map);
}

nav::CommonErrors CommonErrorArguments::in_metres() const {
  return {tip_sd_mm.value_or(0.0) * 1e-3, cameras_sd_mm.value_or(0.0) * 1e-3,
          map_sd_mm.value_or(0.0) * 1e-3};
}

void CommonErrorArguments::set_in(engine::KnownErrors& known) const {
  const auto set = [](const std::optional<double>& sd_mm, std::optional<engine::ErrorSd>& error) {
    if (sd_mm) {
      error = engine::ErrorSd{*sd_mm * 1e-3, engine::ErrorSource::kGiven};
    }
  };
  set(tip_sd_mm, known.tip_m);
  set(cameras_sd_mm, known.cameras_m);
  set(map_sd_mm, known.map_m);
}

}  // namespace orthonav::tools
