#pragma once

#include <optional>
#include <string>

#include "base/vec.h"

namespace orthonav::engine {

/// Patient axes that a file may use: LPS (+x left, +y posterior, +z superior) or RAS (+x right,
/// +y anterior). One is the other turned half round z, so both are right-handed.
enum class Axes { kLps, kRas };

[[nodiscard]] constexpr Vec3 to_lps(Vec3 v, Axes axes) {
  return axes == Axes::kRas ? Vec3{-v.x, -v.y, v.z} : v;
}
/// "LPS" or "RAS", nothing else.
[[nodiscard]] std::optional<Axes> axes_from(const std::string& text);
/// Metres in one "mm" or "m", nothing else.
[[nodiscard]] std::optional<double> metres_per_unit_from(const std::string& text);

}  // namespace orthonav::engine
