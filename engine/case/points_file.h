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
  std::vector<std::string> regions;  ///< one per point, or empty if the file names none
  std::optional<double>
      metres_per_unit;       ///< if the file declares its unit (markups, Slicer's table)
  std::optional<Axes> axes;  ///< if the file declares its axes (markups, Slicer's table)
};

/// Reads CSV, PLY (ascii or binary vertices), or 3D Slicer markups (`.mrk.json`, `.fcsv`; unplaced
/// points do not count). CSV, UTF-8 or UTF-16: `x,y,z` with an optional `region` by the header's
/// names, or the first three columns where there is no header; the separator is `;` or a tab where
/// the first line has one, and a number may then have a decimal comma. 3D Slicer's table of control
/// points (`label,r,a,s,defined,...` or `label,l,p,s,...`) states its axes, in mm. Refuses files
/// without points, anything that is not a finite number, and lines with more fields than the header
/// (decimal commas between commas), naming the line.
Result<PointsFile> load_points(const std::string& path);

}  // namespace orthonav::engine
