#pragma once

#include <CLI/App.hpp>

#include "engine/live/assembled_operation.h"

namespace orthonav::tools {

/// The limits at which a deviation is called good, poor or too large.
struct LimitArguments {
  double good_deg = 2.0;
  double poor_deg = 5.0;
  double wire_deg = 2.0;
  double wire_mm = 2.0;

  void add_to(CLI::App& command);
  [[nodiscard]] engine::GradeLimits grades() const;
  /// Warns on standard error of limits that are wider than the usual ones.
  void set_in(engine::AssemblyOptions& options) const;
};

}  // namespace orthonav::tools
