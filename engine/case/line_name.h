#pragma once

#include <string>

#include "nav/guidance/screw.h"

namespace orthonav::engine {

/// What the name of a planned line says, such as `L4 left`.
struct LineName {
  bool left = false;
  bool right = false;  ///< both: the name contradicts itself
  std::string level;   ///< "L4"; empty: it names none
};

/// Reads whole words of any case, where digits, signs and a capital after a small letter end a
/// word: `left`, `lt`, `links` and `right`, `rt`, `rechts`, `R` say a side. `L` says left right
/// after a level (`L4_L`, `L4L`); elsewhere it says nothing: 3D Slicer itself calls lines `L`,
/// `L_1`, `L_2`.
[[nodiscard]] LineName parsed_line_name(const std::string& name);

}  // namespace orthonav::engine
