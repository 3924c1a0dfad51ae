#pragma once

#include <CLI/App.hpp>

#include "nav/registration/tre.h"

namespace orthonav::tools {

/// Common errors of all strokes, as far as the user knows them: SDs along each axis. 0: not known.
struct CommonErrorArguments {
  double tip_sd_mm = 0.0;
  double cameras_sd_mm = 0.0;
  double map_sd_mm = 0.0;

  void add_to(CLI::App& command);
  [[nodiscard]] nav::CommonErrors in_metres() const {
    return {tip_sd_mm * 1e-3, cameras_sd_mm * 1e-3, map_sd_mm * 1e-3};
  }
};

}  // namespace orthonav::tools
