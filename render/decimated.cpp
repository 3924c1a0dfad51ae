#include "render/decimated.h"

#include <meshoptimizer.h>

#include <limits>

namespace orthonav::render {
namespace {

constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();
constexpr float kAnyError = std::numeric_limits<float>::max();

/// Only the vertices that `indices` use, in the order of their first use.
MeshData compacted(const MeshData& mesh, const std::vector<std::uint32_t>& indices) {
  MeshData out;
  std::vector<std::uint32_t> places(mesh.positions.size(), kUnused);
  out.indices.reserve(indices.size());
  for (const std::uint32_t index : indices) {
    if (places[index] == kUnused) {
      places[index] = static_cast<std::uint32_t>(out.positions.size());
      out.positions.push_back(mesh.positions[index]);
      out.normals.push_back(mesh.normals[index]);
      if (!mesh.tints.empty()) {
        out.tints.push_back(mesh.tints[index]);
      }
    }
    out.indices.push_back(places[index]);
  }
  return out;
}

/// Merges vertices at the same position: a surface of separate triangles (STL) could not be
/// collapsed otherwise.
std::vector<std::uint32_t> joined_indices(const MeshData& mesh) {
  std::vector<std::uint32_t> joined(mesh.indices.size());
  meshopt_generateShadowIndexBuffer(joined.data(), mesh.indices.data(), mesh.indices.size(),
                                    mesh.positions.data(), mesh.positions.size(), sizeof(Float3),
                                    sizeof(Float3));
  return joined;
}

/// Collapses edges until `wanted` indices are left or the error, relative to the extent, is
/// reached.
std::vector<std::uint32_t> collapsed(const MeshData& mesh, const std::vector<std::uint32_t>& joined,
                                     std::size_t wanted, float error, float* reached = nullptr) {
  std::vector<std::uint32_t> indices(joined.size());
  indices.resize(meshopt_simplify(indices.data(), joined.data(), joined.size(),
                                  &mesh.positions.front().x, mesh.positions.size(), sizeof(Float3),
                                  wanted, error, 0, reached));
  return indices;
}

float extent_of(const MeshData& mesh) {
  return meshopt_simplifyScale(&mesh.positions.front().x, mesh.positions.size(), sizeof(Float3));
}

}  // namespace

MeshData decimated(const MeshData& mesh, std::size_t most_triangles) {
  const std::size_t wanted = 3 * most_triangles;
  if (mesh.indices.size() <= wanted) {
    return mesh;
  }
  const std::vector<std::uint32_t> joined = joined_indices(mesh);
  std::vector<std::uint32_t> indices = collapsed(mesh, joined, wanted, kAnyError);
  if (indices.size() > wanted + wanted / 4) {
    indices.resize(joined.size());
    indices.resize(meshopt_simplifySloppy(indices.data(), joined.data(), joined.size(),
                                          &mesh.positions.front().x, mesh.positions.size(),
                                          sizeof(Float3), wanted, kAnyError, nullptr));
  }
  return compacted(mesh, indices);
}

MeshData simplified(const MeshData& mesh, std::size_t enough_triangles, float error_m) {
  const std::size_t enough = 3 * enough_triangles;
  if (mesh.indices.size() <= enough || !(error_m > 0)) {
    return mesh;
  }
  const float extent_m = extent_of(mesh);
  if (!(extent_m > 0)) {
    return mesh;
  }
  return compacted(mesh, collapsed(mesh, joined_indices(mesh), enough, error_m / extent_m));
}

Coarser coarser(const MeshData& mesh, std::size_t triangles, bool joined) {
  if (mesh.indices.empty()) {
    return {mesh, 0};
  }
  float relative = 0;
  const std::vector<std::uint32_t> indices = collapsed(
      mesh, joined ? joined_indices(mesh) : mesh.indices, 3 * triangles, kAnyError, &relative);
  return {compacted(mesh, indices), relative * extent_of(mesh)};
}

}  // namespace orthonav::render
