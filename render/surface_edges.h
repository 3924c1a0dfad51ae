#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "render/frame_items.h"
#include "render/projection.h"
#include "render/scene.h"

namespace orthonav::render {

/// The edges of a surface at which its picture may end or jump: between a triangle that faces the
/// eye and one that does not, along a border, and along creases, where the normals of the two sides
/// differ.
class SurfaceEdges {
 public:
  SurfaceEdges() = default;
  explicit SurfaceEdges(const MeshData& mesh);

  /// Appends the edges that show from the view, as they lie in its image: x and y of one end, then
  /// of the other, in pixels. An edge that reaches behind the near plane is left out.
  /// `faces`: room for one number a triangle.
  void seen_by(const View& view, PixelSize size, const Matrix4& world_from_model,
               std::vector<std::uint8_t>& faces, std::vector<Float4>& edges) const;

 private:
  /// Between two triangles, or twice the same at a border.
  struct Edge {
    std::array<std::uint32_t, 2> ends{};
    std::array<std::uint32_t, 2> triangles{};
    bool crease = false;
  };

  std::vector<Float3> positions_;  ///< no two alike
  std::vector<Float4> planes_;     ///< by triangle: outward normal and offset
  std::vector<Edge> edges_;
};

}  // namespace orthonav::render
