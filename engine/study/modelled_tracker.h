#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "hal/sim/sim_headset.h"
#include "nav/tracking/tool_tracker.h"

namespace orthonav::engine {

/// A tracker for simulated rooms that looks at no pixel: the corners of the tags are drawn by the
/// measurement model of the method (`measurement_model.h`), and all that follows is the method's
/// own. `paper`: its filters and triangulation on these corners. `best`: the pose that explains
/// them best in both cameras as they are described, its filter of poses, and its estimate of how
/// the cameras are turned and, unless told otherwise, how large tags are. The room must outlive it,
/// and be the one that the frames come from.
Result<std::unique_ptr<nav::ToolTracker>> create_modelled_tracker(
    std::string_view method, const sim::SimHeadset& room, const StereoCalibration& calibration,
    std::vector<nav::ToolGeometry> tools, const nav::TrackerOptions& options,
    bool correct_tag_sizes = true);

}  // namespace orthonav::engine
