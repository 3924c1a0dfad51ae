#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "nav/tracking/tool_tracker.h"

namespace orthonav::nav {

/// A tool turns about a fixed point for at least this long, and with at least this spread, as in
/// `PivotOptions`.
inline constexpr double kLeastTurning_s = 3.0;
inline constexpr double kLeastTurningSpread_rad = 0.15;

/// A point of the tool that stayed in place while the tool turned about it.
struct FixedPoint {
  std::size_t first = 0;  ///< poses [first, end)
  std::size_t end = 0;
  Vec3 offset_m{};  ///< from the given tip, in the marker's axes
  double rmse_m = 0.0;
};

/// The longest stretch of poses that turned about a fixed point near the tip; the point is fitted
/// too (least squares as in `pivot_calibration`). Stretches are ranked by length × (1 - (RMSE /
/// limit)²), so that approach and departure, which fit worse, are left out. Times must increase.
[[nodiscard]] std::optional<FixedPoint> longest_fixed_point(
    std::span<const TrackedPose> world_from_marker, Point<Marker> tip);

}  // namespace orthonav::nav
