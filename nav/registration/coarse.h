#pragma once

#include <span>
#include <vector>

#include "nav/registration/registration.h"

namespace orthonav::nav {

/// A start for ICP, and how well it fits a reduced set of the points.
struct CoarsePose {
  Transform<World, Vertebra> world_from_vertebra;
  double rmse_m = 0.0;
};

/// Two clearly different poses that could explain the points, the better one first (only one if
/// nothing else fits at all). The extreme points along the principal axes of the digitized points
/// and of the reachable surface are paired (Liebmann et al. 2019, eq. 1) and fitted (Horn 1987).
///
/// The paper leaves two things open that decide whether this works:
/// - Which axes correspond: strokes cover a different part than the trimmed model, so the spread
///   from side to side and the spread along the spinous process often swap ranks. All 24 proper
///   pairings of axes and signs are tried, never a mirrored one.
/// - ICP stops in the nearest minimum, typically one crest off. Poses are shaken (shifted and
/// turned
///   along the model's principal axes) and refined again until nothing better turns up.
/// The two best of all take the place of the paper's two configurations (eq. 2).
[[nodiscard]] std::vector<CoarsePose> coarse_poses(const VertebraModel& model,
                                                   std::span<const Point<World>> points_in_world);

/// Whether two poses put the model's centre more than 3 mm or 6 degrees apart.
[[nodiscard]] bool differ_clearly(const VertebraModel& model, const Transform<World, Vertebra>& a,
                                  const Transform<World, Vertebra>& b);

}  // namespace orthonav::nav
