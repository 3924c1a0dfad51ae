#pragma once

#include <numbers>

namespace orthonav {

// Degrees are for files, configuration and readouts alone.

inline constexpr double kDegreesPerRadian = 180.0 / std::numbers::pi;
inline constexpr double kRadiansPerDegree = std::numbers::pi / 180.0;

/// For reports and journals. Its last bit may differ from that of a product with
/// `kDegreesPerRadian`; each place keeps its own way, so that what it writes stays the same.
[[nodiscard]] constexpr double degrees(double angle_rad) {
  return angle_rad * 180.0 / std::numbers::pi;
}

}  // namespace orthonav
