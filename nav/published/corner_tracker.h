#pragma once

#include <memory>
#include <vector>

#include "nav/tracking/marker_detector.h"
#include "nav/tracking/tool_tracker.h"

namespace orthonav::nav::published {

/// The tracking of Liebmann et al. 2019, section 3.1: the corners of each tool's first tag in both
/// images (AprilTag 3 in place of the paper's ArUco), a constant-velocity Kalman filter for each,
/// look-up to the unit plane, the point closest to the two rays, absolute orientation (Horn 1987).
/// A tag must be seen by both cameras. The paper's ASCS is World, CCS is Rig, CVS a camera but for
/// diag(1, -1, -1), CPS pixels and unit plane.
Result<std::unique_ptr<ToolTracker>> create_corner_tracker(const StereoCalibration& calibration,
                                                           std::vector<ToolGeometry> tools,
                                                           const TrackerOptions& options = {});

/// The same with corners found elsewhere.
Result<std::unique_ptr<ToolTracker>> create_tracker_of_corners(const StereoCalibration& calibration,
                                                               std::vector<ToolGeometry> tools,
                                                               const TrackerOptions& options,
                                                               std::unique_ptr<TagFinder> finder);

}  // namespace orthonav::nav::published
