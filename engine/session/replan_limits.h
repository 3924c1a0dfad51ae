#pragma once

#include <string>
#include <vector>

#include "engine/case/screw_sizes.h"

namespace orthonav::engine {

/// How far a screw may be changed in surgery in total, compared with the preoperative plan.
struct ReplanLimits {
  double entry_m = 0.010;                ///< of the entry
  double tilt_rad = 0.2617993877991494;  ///< 15°, of the axis
  ScrewSizes sizes = ScrewSizes::built_in();

  /// Every problem at once; empty when all is well.
  [[nodiscard]] std::vector<std::string> check() const;
};

}  // namespace orthonav::engine
