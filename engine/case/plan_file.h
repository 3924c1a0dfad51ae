#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "engine/io/patient_axes.h"
#include "nav/geometry/mesh.h"
#include "nav/guidance/screw.h"

namespace orthonav::engine {

/// A screw as its file states it. The bone decides on which side it lies (`screws_on`).
struct StatedScrew {
  std::string where;              ///< file and place in it: `L4.json: screws[1]`
  std::optional<nav::Side> side;  ///< as stated by the file or the line's name; none: not stated
  Point<Vertebra> entry;
  Point<Vertebra> target;
  double radius_m = 0.0;             ///< 0: none is stated
  std::string accepted_breach = {};  ///< reason why the screw may leave the cortex; empty: it may
                                     ///< not
};

/// A file's plan for one level, in metres and LPS; `axes` and `metres_per_unit` are those of the
/// file, which its model uses too.
struct Plan {
  std::string level;  ///< "L4" if the file states it, otherwise empty
  Axes axes = Axes::kLps;
  double metres_per_unit = 1e-3;
  std::vector<StatedScrew> screws;
};

/// Reads a plan: `{"units": "mm"|"m", "frame": "LPS"|"RAS", "level"?, "screws": [{"side": "left"|
/// "right", "entry", "target", "radius", "accept_breach"?}]}`, or the lines of a 3D Slicer markups
/// file (`.mrk.json`: point 0 entry, point 1 target, side and level from the name (`line_name.h`),
/// or of a file without lines the points of its lists in pairs, side and level from the names of
/// list and entry; `diameter=5.5` in name or description, `accept_breach=` and the reason up to the
/// end of its line in the description). Refuses plans without unit or frame, without screws, names
/// that say both sides, screws shorter than 10 mm or longer than 120 mm, radii outside 1-6 mm, and
/// the legacy `.fcsv`, which has no lines.
Result<Plan> load_plan(const std::string& path);
/// The same from the text of either; `name` stands for the file in messages.
Result<Plan> parse_plan(const std::string& text, const std::string& name);
/// Several files as one plan: of one level, in one frame and unit.
Result<Plan> load_plan(std::span<const std::string> paths);

/// The screws with the side on which each lies on its bone (`OffMidline::side`). The side stated in
/// the file only confirms it, and decides if the position is ambiguous. Refuses, with file and
/// screw, a screw that does not belong to this bone or is written in other axes (`misplaced`), a
/// side that contradicts the position, a side that neither determines, and two screws on one side.
Result<std::vector<nav::ScrewPlan>> screws_on(const nav::TriangleMesh& bone, const Plan& plan);

/// Writes a plan in millimetres and LPS.
Status save_plan(const std::string& path, const std::string& level,
                 std::span<const nav::ScrewPlan> screws);

}  // namespace orthonav::engine
