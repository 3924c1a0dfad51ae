#pragma once

#include <string>
#include <vector>

#include "nav/guidance/screw.h"

namespace orthonav::engine {

/// The meaning of a planned line's name, such as `L4 left`.
struct LineName {
  bool left = false;
  bool right = false;  ///< both: the name contradicts itself
  std::string level;   ///< "L4"; empty: it names none
};

/// Reads whole words of any case; digits, punctuation and a capital after a small letter end a
/// word. `left`, `lt`, `links` and `right`, `rt`, `rechts`, `R` state a side. `L` means left
/// directly after a level (`L4_L`, `L4L`); elsewhere it means nothing, since 3D Slicer itself names
/// lines `L`, `L_1`, `L_2`.
[[nodiscard]] LineName parsed_line_name(const std::string& name);
/// The levels that it names, in its order: "L4", "L5".
[[nodiscard]] std::vector<std::string> levels_named(const std::string& name);

}  // namespace orthonav::engine
