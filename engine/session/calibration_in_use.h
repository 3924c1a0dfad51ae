#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/session/journal_lines.h"
#include "nav/tracking/tool_tracker.h"

namespace orthonav::engine {

class JsonNode;

/// The tags of a tool against the size that its description states, as fractions.
struct TagSizeInUse {
  std::string tool;
  double applied = 0.0;   ///< larger by so much in the poses that were guided on
  double measured = 0.0;  ///< larger by so much as the two cameras saw them
  double sd = 0.0;        ///< of `measured`
};

/// The cameras against what the device reports of them.
struct CamerasInUse {
  double rotation_rad = 0.0;  ///< of the right camera
  bool rotation_applied = false;
  double focal_fraction = 0.0;  ///< of the right one against the left one; poses don't use it
  double focal_sd = 0.0;
  double baseline_fraction = 0.0;  ///< likewise
  double baseline_sd = 0.0;
  std::int64_t pairs = 0;
};

/// What was found out in use about tags and cameras. What is absent was not measured.
struct CalibrationInUse {
  std::vector<TagSizeInUse> tags;
  std::optional<CamerasInUse> cameras;
};

[[nodiscard]] CalibrationInUse calibration_in_use(const nav::ToolTracker& tracker);
/// `tags[]` and `cameras` in percent and degrees; `not_measured[]` names those that were not.
[[nodiscard]] JournalLine calibration_json(const CalibrationInUse& found);
/// What `calibration_json` wrote.
[[nodiscard]] CalibrationInUse calibration_of(const JsonNode& line);

}  // namespace orthonav::engine
