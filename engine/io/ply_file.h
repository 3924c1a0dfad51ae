#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "base/vec.h"

namespace orthonav::engine {

/// The surface in a PLY file, in its own unit and axes.
struct PlyFile {
  std::vector<Vec3> vertices;
  std::vector<std::uint32_t> corners;        ///< vertex indices of all faces, one after another
  std::vector<std::uint32_t> corner_counts;  ///< of each face; sum: all corners
};

/// Reads `text` (ascii, binary little or big endian; Turk 1994, "The PLY Polygon File Format").
/// x, y and z of the vertices must be float or double and finite; a face may have any number of
/// corners, all of which must be vertices of the file. Other elements and properties are skipped.
/// Refuses truncated files. `name` is for messages.
Result<PlyFile> read_ply(const std::string& text, const std::string& name);
/// Only the vertices.
Result<std::vector<Vec3>> ply_points(const std::string& text, const std::string& name);

/// Points as a PLY file, binary little-endian, single precision; `comment` becomes a line of it.
[[nodiscard]] std::string ply_text(std::span<const std::array<float, 3>> points,
                                   const std::string& comment);

}  // namespace orthonav::engine
