#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "nav/geometry/mesh.h"
#include "render/scene.h"

namespace orthonav::engine {

/// The contours of a surface: where it turns away from an eye and nothing hides it. They are found
/// as the zeros of normal · direction to the eye, linear within each triangle of a simplified
/// surface (Hertzmann and Zorin, "Illustrating smooth surfaces", SIGGRAPH 2000, section 4), so they
/// are smooth where the surface is.
class SurfaceContours {
 public:
  using Line = std::vector<render::Float3>;

  static constexpr std::size_t kMaxTriangles = 5000;
  /// Takes some tens of milliseconds for a vertebra.
  explicit SurfaceContours(const render::MeshData& mesh,
                           std::size_t most_triangles = kMaxTriangles);
  /// As seen from `eye`, both in the mesh's own coordinates; the longest line first. A line that
  /// closes ends where it begins.
  [[nodiscard]] std::vector<Line> seen_from(render::Float3 eye) const;
  [[nodiscard]] render::Float3 middle() const { return middle_; }

 private:
  /// Where a contour crosses an edge, and the surface's normal there.
  struct Crossing {
    std::uint64_t edge = 0;
    render::Float3 point{};
    render::Float3 normal{};
  };
  using Segment = std::array<Crossing, 2>;
  [[nodiscard]] std::vector<Segment> segments_from(render::Float3 eye) const;
  [[nodiscard]] bool is_seen(const Segment& segment, render::Float3 eye) const;

  render::MeshData mesh_;
  nav::SurfaceIndex surface_;
  render::Float3 middle_{};
};

/// A line reduced to the points needed to stay within `within_m` of it. The kept points, except the
/// last, do not change when points are added at its end.
[[nodiscard]] SurfaceContours::Line thinned(const SurfaceContours::Line& line, float within_m);

[[nodiscard]] float length_of(const SurfaceContours::Line& line);

}  // namespace orthonav::engine
