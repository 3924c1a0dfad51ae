#pragma once

#include <string>

namespace orthonav::engine {

// A rod in words: a part of engine/session/wording.h.

/// One bend of the instructions (nav/guidance/rod_bends.h).
struct BendToMake {
  std::size_t number = 1;  ///< from 1
  double at_m = 0.0;       ///< its middle, along the axis from the first end
  double roll_rad = 0.0;
  double set_rad = 0.0;  ///< on the bender
};
/// "bend 2: 63 mm, roll 40°, set 18.5°".
void append_bend(std::string& out, const BendToMake& bend);
/// "cut to 112.4 mm".
void append_cut(std::string& out, double length_m);

}  // namespace orthonav::engine
