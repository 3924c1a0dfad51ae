#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "render/projection.h"
#include "render/scene.h"

namespace orthonav::engine {

// Where labels, and the things they must not cover, appear to the eyes. Lengths are tangents of
// visual angles in an eye's view: x to its right, y up, straight ahead at the origin.

struct SeenPoint {
  float x = 0;
  float y = 0;
};

/// An upright rectangle; empty if it is not in front of the eye.
struct SeenBox {
  float left = 1;
  float bottom = 1;
  float right = -1;
  float top = -1;
  [[nodiscard]] bool empty() const { return right < left || top < bottom; }
};
[[nodiscard]] SeenBox grown(const SeenBox& box, float by);

/// The convex hull of up to four points, grown by a radius: a disc, a line, a triangle, a patch.
/// Without points if it is not in front of the eye.
struct SeenOutline {
  std::array<SeenPoint, 4> corners;
  std::size_t count = 0;
  float radius = 0;
};

/// Whether they share more than an edge.
[[nodiscard]] bool overlap(const SeenBox& a, const SeenBox& b);
/// The same; round corners count as square ones.
[[nodiscard]] bool overlap(const SeenOutline& outline, const SeenBox& box);

/// The box for each eye; with one eye, only the first.
using BoxInEyes = std::array<SeenBox, 2>;
using OutlineInEyes = std::array<SeenOutline, 2>;
[[nodiscard]] bool overlap(const BoxInEyes& a, const BoxInEyes& b);
[[nodiscard]] bool overlap(const OutlineInEyes& outline, const BoxInEyes& box);
[[nodiscard]] BoxInEyes grown(const BoxInEyes& boxes, float by);

/// A rectangle in the plane of a text, in its cap heights from its anchor.
struct CapsBox {
  float left = 0;
  float bottom = 0;
  float right = 0;
  float top = 0;
};

/// One or two eyes.
class Eyes {
 public:
  Eyes() = default;
  explicit Eyes(const std::vector<render::View>& views);
  [[nodiscard]] const render::Head& head() const { return head_; }
  [[nodiscard]] BoxInEyes box(const render::Matrix4& world_from_caps, const CapsBox& box) const;
  /// The smallest boxes around a quadrangle in the world, metres.
  [[nodiscard]] BoxInEyes box(const std::array<render::Float3, 4>& corners) const;
  /// Whether every eye sees the whole box.
  [[nodiscard]] bool in_view(const BoxInEyes& boxes) const;
  [[nodiscard]] bool in_view(render::Float3 in_world) const;
  /// What every eye sees, far away.
  [[nodiscard]] SeenBox common_field() const;
  /// Up to four corners in the world, metres.
  [[nodiscard]] OutlineInEyes outline(std::span<const render::Float3> corners,
                                      float radius_m) const;

 private:
  std::size_t count_ = 0;
  std::array<render::Matrix4, 2> eye_from_world_{};
  BoxInEyes fields_{};
  render::Head head_;
};

}  // namespace orthonav::engine
