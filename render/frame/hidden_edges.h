#pragma once

#include <cstdint>
#include <vector>

#include "render/frame/frame_items.h"
#include "render/pixel_rect.h"
#include "render/projection.h"
#include "render/scene.h"

namespace orthonav::render {

/// Two points of a world, or of a surface's own frame.
struct Segment3 {
  Float3 from{};
  Float3 to{};
};

/// A surface in a scene.
struct PlacedSurface {
  std::uint32_t item = 0;  ///< no two alike in a frame
  bool veil = false;       ///< a translucent one, which hides other veils only
  Matrix4 world_from_model{};
};

/// What closed convex surfaces (balls, cylinders, diamonds) hide of the edges of others as seen
/// from one eye. An edge that is drawn although it is hidden would blend pixels of what hides it.
class HiddenEdges {
 public:
  void clear();
  /// A convex surface, followed by its planes: those of its triangles that face the eye, and those
  /// through the eye and its outline. What lies behind all of them is hidden. Its box in the image
  /// is left, top, right, bottom.
  void add(const PlacedSurface& surface, const Float4& box_px);
  /// Normal and offset in the frame of the surface that was added last; positive in front of it.
  void add_plane(const Float4& plane);

  /// Whether a part of an edge of `surface` may be hidden by another surface. `at_px`: its ends in
  /// the image, x and y of one and then of the other.
  [[nodiscard]] bool may_hide(const PlacedSurface& surface, const Float4& at_px) const;
  /// Replaces `shown`, such an edge in the world, by what is not hidden of it.
  void leave_out(const PlacedSurface& surface, const Float4& at_px,
                 std::vector<Segment3>& shown) const;

 private:
  struct Hiding {
    PlacedSurface surface;
    Float4 box_px{};
    std::size_t first_plane = 0;
    std::size_t planes = 0;

    [[nodiscard]] bool may_hide(const PlacedSurface& other, const Float4& at_px) const;
  };
  void leave_out(const Hiding& hiding, std::vector<Segment3>& shown) const;

  std::vector<Hiding> surfaces_;
  std::vector<Float4> planes_;
};

}  // namespace orthonav::render
