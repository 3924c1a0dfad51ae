#pragma once

#include <array>
#include <functional>
#include <span>

#include "render/pixel_rect.h"
#include "render/scene.h"

namespace orthonav::render {

/// Corners of a box in a mesh's own coordinates.
struct Box {
  Float3 low{};
  Float3 high{};
};
[[nodiscard]] Box box_of(const MeshData& mesh);
/// Looks up the box of an item's mesh, which takes too long to be found anew in each frame.
using BoxOf = std::function<Box(const MeshItem&)>;

/// Collects the pixels that the convex hull of points may touch in one or two views, never too few:
/// a hull that crosses the near plane may be anywhere. Rectangles are clipped to the image.
class ScreenBounds {
 public:
  ScreenBounds(std::span<const View> views, int width_px, int height_px);
  /// Starts anew.
  void clear();
  void add(Float3 in_world);
  /// A disc that faces the eye, never smaller than a line's end.
  void add_disc(Float3 in_world, float radius_m);
  void add_box(const Matrix4& world_from_box, const Box& box);
  [[nodiscard]] PixelRect rect() const;

 private:
  struct Extent {
    float left, top, right, bottom;
    bool in_front, behind;
  };
  void add_to_view(std::size_t view, Float3 in_world, float radius_m, float least_px);
  [[nodiscard]] PixelRect rect_in(const Extent& extent) const;

  std::size_t views_;
  std::array<Matrix4, 2> clip_from_world_{};
  std::array<float, 2> scale_px_{};
  std::array<Extent, 2> extents_{};
  float width_px_;
  float height_px_;
};

}  // namespace orthonav::render
