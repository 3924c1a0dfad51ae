#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "base/vec.h"
#include "engine/io/patient_axes.h"

namespace orthonav::engine {

/// Digitized points from a file, in its own unit and axes.
struct PointsFile {
  std::vector<Vec3> points;
  std::vector<std::string> regions;       ///< one per point, or empty if the file names none
  std::optional<double> metres_per_unit;  ///< if the file declares its unit (markups)
  std::optional<Axes> axes;               ///< if the file declares its axes (markups)
};

/// Reads CSV (`x,y,z` with an optional `region`; columns by the header's names, or the first three
/// of a file without header), PLY (ascii or binary vertices), or 3D Slicer markups (`.mrk.json`,
/// `.fcsv`). Refuses files without points and anything that is not a finite number, naming the
/// line.
Result<PointsFile> load_points(const std::string& path);

}  // namespace orthonav::engine
