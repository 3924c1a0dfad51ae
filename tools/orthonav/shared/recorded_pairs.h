#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "hal/replay/replay_headset.h"
#include "nav/calibration/body_sightings.h"
#include "nav/tracking/tool_tracker.h"

namespace orthonav::tools {

/// Calls `take` with every pair of a recording, with progress on standard error; returns the first
/// failure.
Status for_each_pair(replay::ReplayHeadset& recording,
                     const std::function<void(const StereoFrame&)>& use);

/// The poses in which a tool was measured, in the order of time.
struct MeasuredPoses {
  std::int64_t pairs = 0;   ///< of the recording; by another tracker, its frames
  std::string format = {};  ///< of another tracker's poses (tools/orthonav/shared/other_poses.h)
  bool timed = true;        ///< whether the times are known
  std::vector<nav::TrackedPose> world_from_marker;
};
/// Tracks one tool through a recording; refuses an unknown method, unreadable files and a tool
/// whose tags are never seen.
Result<MeasuredPoses> measured_poses(const std::string& recording, const std::string& method,
                                     const nav::ToolGeometry& tool,
                                     const nav::TrackerOptions& options = {});

/// Adds those of the states that were measured.
void add_measured(std::span<const nav::ToolState> states, MeasuredPoses& poses);

/// The tags that a recording's cameras saw.
struct RecordedSightings {
  StereoCalibration calibration;
  std::vector<nav::PairSightings> pairs;
  std::string never_seen = {};  ///< which of them were not, and what was
};
Result<RecordedSightings> recorded_sightings(const std::string& recording,
                                             std::vector<nav::MarkerDefinition> tags);

/// A line on standard error for each tool whose tags were never seen, with those that were, if one
/// of these is no tool's.
void warn_of_never_seen(const nav::ToolTracker& tracker);

/// The best tracking method of this version.
[[nodiscard]] std::string default_method();

}  // namespace orthonav::tools
