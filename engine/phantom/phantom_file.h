#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "engine/phantom/vertebra_shape.h"

namespace orthonav::engine {

/// What data/phantom.json holds.
struct PhantomParameters {
  std::string name;
  std::vector<VertebraMorphometry> levels;  ///< from the top down
  double screw_length_m = 0;
  double screw_diameter_m = 0;
};

/// Reads the parameters (mm and degrees in the text); refuses what is missing or not positive.
Result<PhantomParameters> phantom_parameters(std::string_view json, const std::string& name);

}  // namespace orthonav::engine
