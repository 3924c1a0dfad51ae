#include "render/decimated.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

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

using Indices = std::vector<std::uint32_t>;

/// Merges vertices at the same position: a surface of separate triangles (STL) could not be
/// collapsed otherwise.
Indices joined_indices(const MeshData& mesh, const Indices& indices) {
  Indices joined(indices.size());
  meshopt_generateShadowIndexBuffer(joined.data(), indices.data(), indices.size(),
                                    mesh.positions.data(), mesh.positions.size(), sizeof(Float3),
                                    sizeof(Float3));
  return joined;
}

/// Collapses edges until `wanted` indices are left or the error, relative to the extent, is
/// reached.
Indices collapsed(const MeshData& mesh, const Indices& joined, std::size_t wanted, float error,
                  float* reached = nullptr) {
  Indices indices(joined.size());
  indices.resize(meshopt_simplify(indices.data(), joined.data(), joined.size(),
                                  &mesh.positions.front().x, mesh.positions.size(), sizeof(Float3),
                                  wanted, error, 0, reached));
  return indices;
}

float extent_of(const MeshData& mesh) {
  return meshopt_simplifyScale(&mesh.positions.front().x, mesh.positions.size(), sizeof(Float3));
}

/// About so many of the triangles of `indices` at most.
Indices reduced(const MeshData& mesh, Indices all, std::size_t most_triangles) {
  const std::size_t wanted = 3 * most_triangles;
  if (all.size() <= wanted) {
    return all;
  }
  const Indices joined = joined_indices(mesh, all);
  Indices indices = collapsed(mesh, joined, wanted, kAnyError);
  if (indices.size() > wanted + wanted / 4) {
    indices.resize(joined.size());
    indices.resize(meshopt_simplifySloppy(indices.data(), joined.data(), joined.size(),
                                          &mesh.positions.front().x, mesh.positions.size(),
                                          sizeof(Float3), wanted, kAnyError, nullptr));
  }
  return indices;
}

bool is_valid(const MeshData& mesh) {
  return !mesh.positions.empty() && mesh.indices.size() % 3 == 0 &&
         std::all_of(mesh.indices.begin(), mesh.indices.end(),
                     [&](std::uint32_t index) { return index < mesh.positions.size(); }) &&
         std::all_of(mesh.positions.begin(), mesh.positions.end(), [](Float3 p) {
           return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
         });
}

/// The mesh as it is drawn from nearby.
Indices finest(const MeshData& mesh, const MeshDetail& detail, float extent) {
  const std::size_t enough = 3 * detail.enough_triangles;
  if (mesh.indices.size() <= enough) {
    return mesh.indices;
  }
  const bool simplifies = detail.error > 0 && extent > 0;
  return reduced(mesh,
                 simplifies ? collapsed(mesh, joined_indices(mesh, mesh.indices), enough,
                                        detail.error / extent)
                            : mesh.indices,
                 detail.most_triangles);
}

}  // namespace

MeshData decimated(const MeshData& mesh, std::size_t most_triangles) {
  return mesh.indices.size() <= 3 * most_triangles
             ? mesh
             : compacted(mesh, reduced(mesh, mesh.indices, most_triangles));
}

std::shared_ptr<const MeshData> prepared(MeshData mesh, const MeshDetail& detail) {
  constexpr std::size_t kFewTriangles = 64;  // fewer cost next to nothing
  constexpr double kWorthwhile = 0.85;       // of the triangles of the level before
  auto made = std::make_shared<MeshData>(std::move(mesh));
  made->levels.clear();
  if (made->indices.empty() || !is_valid(*made)) {
    return made;
  }
  const float extent = extent_of(*made);
  made->levels.push_back({finest(*made, detail, extent), 0});
  const auto all = static_cast<double>(made->levels.front().indices.size() / 3);
  // Where two vertices lie at one place they stay apart, as at the rim of a cap, unless the surface
  // is large: then one of separate triangles gets fewer as well.
  const bool large = made->indices.size() > 3 * detail.enough_triangles;
  const Indices joined = large ? joined_indices(*made, made->indices) : made->indices;
  for (const double share : {0.7, 0.5, 0.3}) {
    const auto wanted = static_cast<std::size_t>(share * all);
    if (wanted < kFewTriangles) {
      break;
    }
    float relative = 0;
    Indices fewer = collapsed(*made, joined, 3 * wanted, kAnyError, &relative);
    if (fewer.empty() ||
        static_cast<double>(fewer.size()) >
            kWorthwhile * static_cast<double>(made->levels.back().indices.size())) {
      break;
    }
    made->levels.push_back({std::move(fewer), relative * extent});
  }
  return made;
}

}  // namespace orthonav::render
