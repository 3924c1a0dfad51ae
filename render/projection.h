#pragma once

#include <optional>
#include <vector>

#include "render/scene.h"

namespace orthonav::render {

/// Nothing closer to an eye than this is drawn, metres.
inline constexpr float kNearPlane_m = 0.02f;

/// Continuous pixel coordinates, the top-left pixel's centre is (0.5, 0.5).
struct PixelPoint {
  float x_px = 0;
  float y_px = 0;
  float depth_m = 0;  ///< along the view's axis
};

/// The position between the eyes and the orientation of the head; axes are unit vectors in the
/// world.
struct Head {
  Float3 position{};
  Float3 right{1, 0, 0};
  Float3 up{0, 1, 0};
  Float3 back{0, 0, 1};
};

/// The product with (p, 1); the last row is taken as (0, 0, 0, 1).
[[nodiscard]] Float3 transformed(const Matrix4& m, Float3 p);
/// The point that `transformed` takes to p, of a rotation, a scale and a translation.
[[nodiscard]] Float3 transformed_back(const Matrix4& m, Float3 p);
/// The inverse of a rotation and a translation.
[[nodiscard]] Matrix4 rigid_inverse(const Matrix4& m);

/// The matrix that the shaders use: x right, y down, depth 0 at the near plane, 1 at infinity.
[[nodiscard]] Matrix4 clip_from_world(const View& view);

/// Where a point appears in an image of this size; empty if it lies in front of the near plane.
[[nodiscard]] std::optional<PixelPoint> project(const View& view, Float3 in_world, int width_px,
                                                int height_px);

/// The head of one or two views; for two, the point midway between the eyes and their mean
/// direction.
[[nodiscard]] Head head_of(const std::vector<View>& views);

/// A view from `eye` towards `target`, with `up` as far up as possible. Tangents as in View.
[[nodiscard]] View look_at(Float3 eye, Float3 target, Float3 up, float tan_across, float tan_up);

/// Left and right eye around the view in the middle, `eyes_apart_m` apart.
[[nodiscard]] std::vector<View> stereo_pair(const View& between, float eyes_apart_m = 0.063f);

}  // namespace orthonav::render
