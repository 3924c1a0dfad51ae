#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "nav/tracking/tool_tracker.h"

namespace orthonav::nav {

/// Two visible references count as having moved relative to each other by more than this, or by
/// 0.6°, if this many pairs in a row show it: a single pair may be wrong.
inline constexpr double kReferenceMoved_m = 0.001;
inline constexpr int kReferenceMovedPairs = 10;

/// Tracks with `tracker`, and gives poses relative to the patient references among its tools, from
/// a tool and a reference in the same pair, so that motion of head, map and patient cancels. The
/// covariances combine those of the two poses, the reference's at the lever arm to the tool.
/// Without a visible reference the tools are predicted for `coast`, then lost; of poses that a
/// device measured (`take`) nothing is filtered or predicted. `known`: where references lie in the
/// World of a resumed operation; no reference then defines a new World. Refuses tools without a
/// reference, and a place for a tool that is not one. `tracker` must give the poses of single pairs
/// (`ToolState::pair`).
Result<std::unique_ptr<ToolTracker>> create_anchored_tracker(
    std::unique_ptr<ToolTracker> tracker, Duration coast,
    std::span<const ReferencePlace> known = {});

/// The covariance, in the reference's parent frame, of a tool's pose relative to a reference: both
/// covariances in the frame of the pair, the reference's carried over the lever arm from its origin
/// to the tool's.
[[nodiscard]] PoseCovariance relative_covariance(const PairPose& tool, const PairPose& reference);

}  // namespace orthonav::nav
