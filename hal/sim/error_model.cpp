#include "hal/sim/error_model.h"

#include "base/printed.h"
#include "hal/sim/magnitudes.h"

namespace orthonav::sim {

ErrorModel ErrorModel::perfect() {
  ErrorModel none;
  for (const Magnitude& magnitude : magnitudes()) {
    if (magnitude.value != &ErrorModel::pace) {
      none.*magnitude.value = 0.0;
    }
  }
  return none;
}

ErrorModel ErrorModel::navigation_alone() {
  ErrorModel alone;
  for (double ErrorModel::*later :
       {&ErrorModel::entry_pick_m, &ErrorModel::head_pick_m, &ErrorModel::angle_reading_rad,
        &ErrorModel::overlay_perception_m, &ErrorModel::overlay_comparison_m,
        &ErrorModel::overlay_aligning_rad, &ErrorModel::misreading_probability,
        &ErrorModel::hand_drilling_rad, &ErrorModel::hand_drilling_corrected_rad,
        &ErrorModel::wire_skiving_m, &ErrorModel::wire_bending_rad,
        &ErrorModel::hole_following_rad}) {
    alone.*later = 0.0;
  }
  return alone;
}

std::vector<std::string> ErrorModel::check() const {
  std::vector<std::string> problems;
  for (const Magnitude& magnitude : magnitudes()) {
    const double value = this->*magnitude.value;
    // Negated, so that NaN fails too.
    if (!(value >= magnitude.lowest && value <= magnitude.highest)) {
      problems.push_back(printed("magnitude %s is %g, must lie in [%g, %g]",
                                 std::string(magnitude.name).c_str(), value, magnitude.lowest,
                                 magnitude.highest));
    }
  }
  return problems;
}

}  // namespace orthonav::sim
