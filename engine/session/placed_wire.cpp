#include "engine/session/placed_wire.h"
#include "base/angle.h"
#include "base/printed.h"

namespace orthonav::engine {

std::vector<std::string> PlacedWireRules::check() const {
  std::vector<std::string> problems;
  const auto in = [&problems](const char* name, double value, double most) {
    if (!(value > 0.0 && value <= most)) {
      problems.push_back(std::string("placed.") + name + " must lie in (0, " +
                         std::to_string(most) + "]");
    }
  };
  in("angle_limit_rad", angle_limit_rad, 0.2);
  in("entry_limit_m", entry_limit_m, 0.01);
  in("most_entry_sd_m", most_entry_sd_m, 0.01);
  in("drill_diameter_m", drill_diameter_m, 0.01);
  for (const double sd : {axis_sd_rad, tip_sd_m, play_rad}) {
    if (!(sd >= 0.0 && sd <= 0.1)) {
      problems.emplace_back("SDs of placed must lie in [0, 0.1]");
    }
  }
  return problems;
}

void append_wire(std::string& out, const PlacedWire& wire) {
  const nav::PlacedAxis& axis = wire.axis;
  append_printed(out, "%.1f°, %.1f mm", degrees(axis.angle_rad.value), axis.entry_m.value * 1e3);
}

}  // namespace orthonav::engine
