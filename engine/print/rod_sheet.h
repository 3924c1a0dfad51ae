#pragma once

#include <string>

#include "engine/print/page.h"
#include "nav/guidance/rod_bends.h"

namespace orthonav::engine {

/// Text on the page in addition to the instructions.
struct RodSheetNotes {
  std::string title;     ///< "heads.csv", "left"; may be empty
  std::string material;  ///< as stated
  double diameter_m = 0.0055;
  double bender_width_m = 0.020;
  double smallest_radius_m = 0.0275;
};

/// One page with the instructions as a table, a dial for each bend's roll, the straight rod at 1:1
/// in rows with the bends marked, to lay the rod on, and the finished rod at 1:1 in the two planes
/// through the drawn line and across it. Refuses a page too small for them, with sizes.
Result<Sheet> rod_sheet(const nav::RodInstructions& told, const RodSheetNotes& notes,
                        const Page& page);

}  // namespace orthonav::engine
