#pragma once

#include <array>
#include <cmath>

namespace orthonav {

/// IEC 61966-2-1: light in [0, 1] and how sRGB encodes it, in [0, 1] too.
[[nodiscard]] inline double srgb_from_linear(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}
[[nodiscard]] inline double linear_from_srgb(double srgb) {
  return srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4);
}

/// The luminance of linear red, green and blue, relative to white (ITU-R BT.709).
inline constexpr std::array<double, 3> kLuminance = {0.2126, 0.7152, 0.0722};

}  // namespace orthonav
