#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "nav/tracking/anchor.h"
#include "nav/tracking/tool_tracker.h"

namespace orthonav::nav {

/// When two references that are both in sight no longer lie as they did.
struct ReferenceLimits {
  double moved_m = 0.001;
  double moved_rad = 0.0105;  ///< 0.6°
  /// So many pairs in a row: a single pair may be wrong.
  int pairs = 10;
  /// A further reference counts once it was seen in so many pairs together with one that does.
  int learnt_from_pairs = 30;

  /// Every problem at once; empty when all is well.
  [[nodiscard]] std::vector<std::string> check() const;
};

/// Tracks by `tracker`, with poses relative to the patient references among its tools: a tool and a
/// reference of the same pair, so that head, map and patient motion cancel. The covariances are
/// those of the two poses, the reference's at the lever arm to the tool. Without a reference in
/// sight the tools are predicted for `coast`, then lost; where `tracker` follows no tools, nothing
/// is filtered or predicted. `known`: where references lie in the World of a resumed operation;
/// then no reference defines a new one. Refuses tools without a reference, a place of a tool that
/// is no reference, and limits with problems. `tracker` must give the poses of single pairs
/// (`ToolState::pair`).
Result<std::unique_ptr<ToolTracker>> create_anchored_tracker(
    std::unique_ptr<ToolTracker> tracker, Duration coast, const ReferenceLimits& limits = {},
    std::span<const ReferencePlace> known = {});

/// The covariance, in the reference's parent frame, of a tool's pose relative to a reference: both
/// covariances in the frame of the pair, the reference's carried over the lever arm from its origin
/// to the tool's.
[[nodiscard]] PoseCovariance relative_covariance(const PairPose& tool, const PairPose& reference);

}  // namespace orthonav::nav
