#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "render/frame/frame_items.h"
#include "render/frame/hidden_edges.h"
#include "render/projection.h"
#include "render/scene.h"

namespace orthonav::render {

/// What SurfaceEdges needs room for; kept from frame to frame.
struct EdgeScratch {
  /// A visible edge: its ends as indices of the surface's positions, and in the image.
  struct Shown {
    std::array<std::uint32_t, 2> ends{};
    Float4 at_px{};
  };
  std::vector<std::uint8_t> faces;  ///< by triangle
  std::vector<std::uint8_t> axes;   ///< by position
  std::vector<Shown> shown;
  std::vector<Segment3> parts;  ///< of one edge
};

/// The edges of a surface at which its image may end or change abruptly: between a triangle that
/// faces the eye and one that does not, along a border, and along creases, where the normals of the
/// two sides differ.
class SurfaceEdges {
 public:
  SurfaceEdges() = default;
  /// Of those triangles of the mesh.
  SurfaceEdges(const MeshData& mesh, std::span<const std::uint32_t> indices);
  explicit SurfaceEdges(const MeshData& mesh) : SurfaceEdges(mesh, mesh.indices) {}

  /// Adds what the surface hides of others, if it is closed and convex.
  void hide(const View& view, PixelSize size, const PlacedSurface& surface, EdgeScratch& scratch,
            HiddenEdges& hidden) const;

  /// Appends the edges that show from the view, as they lie in its image: x and y of one end, then
  /// of the other, in pixels; as one goes along it, a triangle that faces the eye is on the left.
  /// Edges that turn a corner are drawn slightly too long, so that no pixel is missed. What is
  /// hidden, and an edge that crosses the near plane, is left out.
  void seen_by(const View& view, PixelSize size, const PlacedSurface& surface,
               const HiddenEdges& hidden, EdgeScratch& scratch, std::vector<Float4>& edges) const;

 private:
  /// Between two triangles, or twice the same at a border.
  struct Edge {
    std::array<std::uint32_t, 2> ends{};
    std::array<std::uint32_t, 2> triangles{};  ///< on the left and on the right of it, from outside
    bool crease = false;
    bool hollow = false;  ///< its triangles hide it wherever only one of them faces the eye
  };

  void find_shown(const Matrix4& clip_from_model, PixelSize size, EdgeScratch& scratch) const;

  bool convex_ = false;            ///< and closed, in one piece
  std::vector<Float3> positions_;  ///< no two alike
  std::vector<Float4> planes_;     ///< by triangle: outward normal and offset
  std::vector<Edge> edges_;
};

}  // namespace orthonav::render
