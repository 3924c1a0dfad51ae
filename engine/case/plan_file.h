#pragma once

#include <string>
#include <vector>

#include "base/result.h"
#include "engine/io/patient_axes.h"
#include "nav/guidance/screw.h"

namespace orthonav::engine {

/// The screws of one level, in metres and LPS; `axes` and `metres_per_unit` are what the file used,
/// and what the model beside it uses.
struct Plan {
  std::string level;  ///< "L4" where the file says so, else empty
  Axes axes = Axes::kLps;
  double metres_per_unit = 1e-3;
  std::vector<nav::ScrewPlan> screws;
};

/// Reads a plan: `{"units": "mm"|"m", "frame": "LPS"|"RAS", "level"?, "screws": [{"side": "left"|
/// "right", "entry", "target", "radius"}]}`, or the lines of a 3D Slicer markups file (`.mrk.json`:
/// point 0 entry, point 1 target, side from the name, `diameter=5.5` in name or description; radius
/// 0 where none is given). Refuses plans without unit or frame, without screws, with two screws on
/// one side, screws shorter than 10 mm or longer than 120 mm, radii outside 1-6 mm, and the
/// legacy `.fcsv`, which knows no lines.
Result<Plan> load_plan(const std::string& path);

/// Writes a plan in millimetres and LPS.
Status save_plan(const std::string& path, const Plan& plan);

}  // namespace orthonav::engine
