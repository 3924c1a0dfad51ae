#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"

namespace orthonav {

/// For each vertex of a triangle surface, the sum over its triangles of twice their area (m²) along
/// their normal, which is outward where the triangles run anticlockwise seen from outside. Summed
/// in the order of the triangles, so that one mesh gives the same bits everywhere. Zero for a
/// vertex without triangles. Every index must be that of a vertex.
[[nodiscard]] std::vector<Vec3> vertex_areas_m2(
    std::span<const Vec3> vertices_m, std::span<const std::array<std::uint32_t, 3>> triangles);

/// Their directions, that is, the area-weighted mean of the normals of each vertex's triangles:
/// unit vectors, or zero where the sum is zero.
[[nodiscard]] std::vector<Vec3> vertex_normals(
    std::span<const Vec3> vertices_m, std::span<const std::array<std::uint32_t, 3>> triangles);

}  // namespace orthonav
