#pragma once

#include <optional>
#include <string>

#include "base/vec.h"

namespace orthonav::engine {

/// Patient axes that a file may use: LPS (+x left, +y posterior, +z superior) or RAS (+x right, +y
/// anterior). They differ by a turn of 180° about z, so both are right-handed.
enum class Axes { kLps, kRas };

[[nodiscard]] constexpr Vec3 to_lps(Vec3 v, Axes axes) {
  return axes == Axes::kRas ? Vec3{-v.x, -v.y, v.z} : v;
}
/// From "LPS" or "RAS"; nothing for any other text.
[[nodiscard]] std::optional<Axes> axes_from(const std::string& text);
/// Metres per "mm" or "m"; nothing for any other text.
[[nodiscard]] std::optional<double> metres_per_unit_from(const std::string& text);

}  // namespace orthonav::engine
