#pragma once

#include <string>

#include "base/result.h"
#include "engine/report/registration_figures.h"
#include "tools/orthonav/register/register_inputs.h"
#include "tools/orthonav/shared/json_output.h"

namespace orthonav::tools {

/// Where a registration goes besides the terminal.
struct RegisterOutputs {
  JsonOutput json;
  std::string report;     ///< empty: none
  std::string transform;  ///< for 3D Slicer, `.tfm` or `.h5`; empty: none

  /// Refuses places that can't be written, before the work.
  [[nodiscard]] Status check() const;
  /// Refuses a transform for points whose axes nobody states: where 3D Slicer shows them is
  /// unknown. `points` is the name of their file.
  [[nodiscard]] Status check_inputs(const RegisterInputs& inputs, const std::string& points) const;
  /// Writes all of it; the transform only if the registration was accepted, since a refused pose
  /// looks as good as any other in 3D Slicer.
  [[nodiscard]] Status write(const engine::RegisteredLevel& level, const RegisterInputs& inputs,
                             const std::string& points) const;
};

}  // namespace orthonav::tools
