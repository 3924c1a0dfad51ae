#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "nav/tracking/tool_tracker.h"

namespace orthonav::nav {

/// For a device that measures tools itself (ToolPoseSource): takes its poses and passes them on
/// unchanged, with the covariance stated for them. Nothing is filtered, predicted or guessed. What
/// its poses have in common is World, which stands for Rig in `ToolState`. Tools that the device
/// does not name are always lost; refuses names that no tool has, and tools with problems.
Result<std::unique_ptr<ToolTracker>> create_tracker_of_poses(std::span<const std::string> measured,
                                                             std::vector<ToolGeometry> tools);

}  // namespace orthonav::nav
