#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "hal/sim/sim_headset.h"
#include "nav/tracking/tool_tracker.h"

namespace orthonav::engine {

/// A tracker for simulated rooms that uses no pixels: the corners of the tags are drawn from the
/// measurement model of the method (`measurement_model.h`), and everything after that is the
/// method's own. `paper`: its filters and triangulation on these corners. `best`: the pose that
/// explains them best in both cameras as described, its filter of poses, and its estimate of the
/// cameras' rotation and, by default, of tag sizes. The room must outlive it, and must be the
/// source of the frames.
Result<std::unique_ptr<nav::ToolTracker>> create_modelled_tracker(
    std::string_view method, const sim::SimHeadset& room, const StereoCalibration& calibration,
    std::vector<nav::ToolGeometry> tools, const nav::TrackerOptions& options,
    bool correct_tag_sizes = true);

}  // namespace orthonav::engine
