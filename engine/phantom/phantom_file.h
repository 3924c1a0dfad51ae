#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "engine/phantom/vertebra_shape.h"

namespace orthonav::engine {

/// The content of data/phantom.json.
struct PhantomParameters {
  std::string name;
  std::vector<VertebraMorphometry> levels;  ///< from the top down
  double screw_length_m = 0;
  double screw_diameter_m = 0;
};

/// Reads the parameters (mm and degrees in the text); refuses missing or non-positive values.
Result<PhantomParameters> phantom_parameters(std::string_view json, const std::string& name);

}  // namespace orthonav::engine
