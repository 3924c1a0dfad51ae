#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>

#include "engine/session/known_errors.h"

namespace orthonav::tools {

/// Common errors of all strokes, as far as the user knows them: SDs along each axis.
struct CommonErrorArguments {
  std::optional<double> tip_sd_mm;
  std::optional<double> cameras_sd_mm;
  std::optional<double> map_sd_mm;

  /// What counts where one is not given, for the help text.
  struct Otherwise {
    std::string tip = "0, not known";
    std::string cameras = "0, not known";
    std::string map = "0, not known";
  };
  void add_to(CLI::App& command, const Otherwise& otherwise);
  /// 0 where nothing is given.
  [[nodiscard]] nav::CommonErrors in_metres() const;
  /// Overrides what is known otherwise.
  void set_in(engine::KnownErrors& known) const;
};

}  // namespace orthonav::tools
