#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "base/result.h"
#include "nav/registration/registration.h"

namespace orthonav::engine {

/// Identifies the mesh that parts were made from: its size and CRC-32s of its numbers.
struct MeshKey {
  std::uint64_t vertices = 0;
  std::uint64_t triangles = 0;
  std::uint32_t vertices_crc = 0;
  std::uint32_t triangles_crc = 0;
  friend bool operator==(const MeshKey&, const MeshKey&) = default;

  [[nodiscard]] static MeshKey of(const nav::TriangleMesh& mesh);
  /// 16 hexadecimal digits, for a file's name.
  [[nodiscard]] std::string text() const;
};

/// A file of prepared parts as bytes, little-endian:
///
///     0  "ORTHONAV-MODEL" CR LF
///    16  u32 version of this layout, u32 nav::kPreparationVersion
///    24  u32, u32 CRC-32 of the mesh's vertices and triangles; u64, u64 their counts
///    48  u64, u64, u64 counts of reachable faces, closest points, distances
///    72  faces (u32), closest points (3 doubles each, m), distances (float, m)
///        u32 CRC-32 of everything before
[[nodiscard]] std::string encoded(const MeshKey& key, const nav::PreparedParts& parts);

/// The parts, or briefly why the bytes do not belong to this mesh and version: damaged, or of
/// another mesh, version or kind. No size is trusted before the content is known to be that large.
Result<nav::PreparedParts> decoded(std::string_view bytes, const MeshKey& key);

/// Upper bound on the size of such a file: a mesh has at most 250 mm.
inline constexpr std::uint64_t kMaxPartsBytes = 64u << 20u;

}  // namespace orthonav::engine
