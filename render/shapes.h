#pragma once

#include <span>
#include <vector>

#include "render/scene.h"

namespace orthonav::render {

// Make plain geometry, in metres. Surfaces are closed, triangles counter-clockwise as seen from
// outside, normals outward. Without extent (a radius that is not positive, a path without two
// distinct points, a number that is not finite) the result is an empty mesh, never a broken one.

/// Unit normals of a surface, one per vertex: the triangles' normals weighted by their angle there.
/// A vertex without a usable triangle gets +z. An index out of range is ignored.
[[nodiscard]] std::vector<Float3> smooth_normals(std::span<const Float3> positions,
                                                 std::span<const std::uint32_t> indices);

/// Around the origin; scale and place it with `MeshItem::world_from_model`.
[[nodiscard]] MeshData make_sphere(float radius_m, int slices = 24, int stacks = 12);

/// Around the origin, its six tips on the axes; flat faces.
[[nodiscard]] MeshData make_octahedron(float radius_m);

/// From one end's centre to the other's, with flat caps.
[[nodiscard]] MeshData make_cylinder(Float3 from, Float3 to, float radius_m, int slices = 24);

/// A round tube along a path, with flat caps; the cross-section is carried along without twist.
[[nodiscard]] MeshData make_tube(std::span<const Float3> path, float radius_m, int slices = 16);

/// The points of a circle, to be drawn as a closed line; replaces the content of the list.
void set_ring(std::vector<Float3>& ring, Float3 centre, Float3 normal, float radius_m,
              int points = 48);
[[nodiscard]] std::vector<Float3> make_ring(Float3 centre, Float3 normal, float radius_m);

/// The matrix that scales by `scale` and then moves to `position`.
[[nodiscard]] Matrix4 placed_at(Float3 position, float scale = 1.0f);

}  // namespace orthonav::render
