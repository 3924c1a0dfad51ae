#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "base/vec.h"

namespace orthonav::engine {

/// The vertices of a PLY file (ascii, binary little or big endian); faces are ignored. The vertex
/// element must come first, and x, y and z must be float or double.
Result<std::vector<Vec3>> ply_points(const std::string& text, const std::string& name);

/// Points as a PLY file, binary little-endian, single precision; `comment` becomes a line of it.
[[nodiscard]] std::string ply_text(std::span<const std::array<float, 3>> points,
                                   const std::string& comment);

}  // namespace orthonav::engine
