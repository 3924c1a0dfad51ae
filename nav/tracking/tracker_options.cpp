#include <cmath>
#include <string>

#include "base/joined.h"
#include "nav/tracking/tool_tracker.h"

namespace orthonav::nav {

Status check(const StereoCalibration& calibration, const std::vector<ToolGeometry>& tools,
             const TrackerOptions& options) {
  if (const auto problems = problems_of(tools); !problems.empty()) {
    return Error{"tools: " + joined(problems)};
  }
  for (const ToolGeometry& tool : tools) {
    if (!tool.has_tag()) {
      return Error{"tools: tool '" + tool.name +
                   "' has no tag, and cameras find a tool by its tag alone"};
    }
  }
  if (calibration.left.width_px() <= 0 || calibration.right.width_px() <= 0) {
    return Error{"tracker: the stereo calibration has no camera model"};
  }
  if (options.full_search_interval < 1) {
    return Error{"tracker: full_search_interval " + std::to_string(options.full_search_interval) +
                 ", must be at least 1"};
  }
  if (options.coast < Duration::zero()) {
    return Error{"tracker: coast is negative"};
  }
  return {};
}

}  // namespace orthonav::nav
