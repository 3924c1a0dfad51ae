#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "nav/tracking/tool_tracker.h"

namespace orthonav::engine {

/// The size of a tool's tags compared with its description, as fractions.
struct TagSizeInUse {
  std::string tool;
  double applied = 0.0;   ///< excess size used in the poses that were guided on
  double measured = 0.0;  ///< excess size as measured by the two cameras
  double sd = 0.0;        ///< of `measured`
};

/// The cameras compared with what the device reports of them.
struct CamerasInUse {
  double rotation_rad = 0.0;  ///< of the right camera
  bool rotation_applied = false;
  double focal_fraction = 0.0;  ///< of the right one against the left one; poses don't use it
  double focal_sd = 0.0;
  double baseline_fraction = 0.0;  ///< likewise
  double baseline_sd = 0.0;
  std::int64_t pairs = 0;
};

/// What was found out in use about tags and cameras. Absent values were not measured.
struct CalibrationInUse {
  std::vector<TagSizeInUse> tags;
  std::optional<CamerasInUse> cameras;
  std::int64_t pairs_refused = 0;  ///< since their two pictures contradict each other
};

[[nodiscard]] CalibrationInUse calibration_in_use(const nav::ToolTracker& tracker);

}  // namespace orthonav::engine
