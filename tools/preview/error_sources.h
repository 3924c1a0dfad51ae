#pragma once

#include <span>

#include "hal/sim/error_model.h"

namespace orthonav::preview {

/// One imperfection of the simulated room as a slider shows it.
struct ErrorSource {
  const char* group;
  const char* name;
  const char* unit;
  double sim::ErrorModel::*value;
  double scale;  ///< shown = scale * value
  double most;   ///< the largest value shown; the smallest is `least`
  double least = 0.0;
};

/// The ones that users may want to change, in groups.
[[nodiscard]] std::span<const ErrorSource> error_sources();

}  // namespace orthonav::preview
