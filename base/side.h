#pragma once

#include <cstdint>

namespace orthonav {

/// A side of the patient, never of the viewer.
enum class Side : std::uint8_t { kLeft, kRight };

/// "left" or "right", as in files.
[[nodiscard]] constexpr const char* name_of(Side side) {
  return side == Side::kLeft ? "left" : "right";
}

}  // namespace orthonav
