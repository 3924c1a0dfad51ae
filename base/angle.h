#pragma once

#include <numbers>

namespace orthonav {

// Degrees are used only in files, configuration and readouts.

inline constexpr double kDegreesPerRadian = 180.0 / std::numbers::pi;
inline constexpr double kRadiansPerDegree = std::numbers::pi / 180.0;

/// For reports. Its last bit may differ from that of a product with
/// `kDegreesPerRadian`; each caller keeps the method it has, so that its output stays the same.
[[nodiscard]] constexpr double degrees(double angle_rad) {
  return angle_rad * 180.0 / std::numbers::pi;
}

}  // namespace orthonav
