#pragma once

#include <string>
#include <vector>

#include "base/result.h"
#include "base/vec.h"
#include "engine/io/json_document.h"
#include "engine/io/patient_axes.h"

namespace orthonav::engine {

struct MarkupPoint {
  std::string label;
  Vec3 position;  ///< in the file's unit and axes
};

/// One markup of a 3D Slicer file; only defined control points.
struct Markup {
  std::string type;  ///< "Fiducial", "Line", ...
  std::string name;
  std::string description;
  std::vector<MarkupPoint> points;
};

struct MarkupsFile {
  Axes axes = Axes::kLps;
  double metres_per_unit = 1e-3;
  std::vector<Markup> markups;
};

/// Reads `.mrk.json` (markups schema 1.0). Refuses markups without `coordinateSystem` (LPS or RAS)
/// or `coordinateUnits` (mm or m), and files whose markups differ in either.
Result<MarkupsFile> load_markups(const std::string& path);
/// The same from a document that was read already, or the Error why it was not; `name` stands for
/// the file in messages.
Result<MarkupsFile> markups_in(const Result<JsonDocument>& document, const std::string& name);

/// Reads the legacy `.fcsv` (always mm); refuses one without `# CoordinateSystem`, or whose
/// `# columns` do not begin as Slicer writes them.
Result<MarkupsFile> load_fcsv(const std::string& path);

/// Refuses a scene of 3D Slicer (`.mrml`, `.mrb`): it names its parts, which have files of their
/// own. `instead`: what to export, as in "save its points as .mrk.json".
Status check_no_scene(const std::string& path, const std::string& instead);
[[nodiscard]] bool is_markups_name(const std::string& path);

}  // namespace orthonav::engine
