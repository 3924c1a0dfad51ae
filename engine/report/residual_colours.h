#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace orthonav::engine {

/// Blue inside the bone, white on it, red outside (ColorBrewer's RdBu, safe for the colour-blind).
inline constexpr std::array<const char*, 9> kResidualColours = {"#2166ac", "#4393c3", "#92c5de",
                                                                "#d1e5f0", "#f7f7f7", "#fddbc7",
                                                                "#f4a582", "#d6604d", "#b2182b"};

/// The colour's index for a residual, the last one from `full_m` on.
[[nodiscard]] inline std::size_t residual_colour(double residual_m, double full_m) {
  const double middle = (kResidualColours.size() - 1) / 2.0;
  const double at = std::round(middle + middle * std::clamp(residual_m / full_m, -1.0, 1.0));
  return static_cast<std::size_t>(at);
}

}  // namespace orthonav::engine
