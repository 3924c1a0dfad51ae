#include "render/projection.h"

#include "render/float3.h"

namespace orthonav::render {
namespace {

Float3 row(const Matrix4& m, std::size_t r) { return {m[r], m[4 + r], m[8 + r]}; }

Float3 eye_position(const View& view) {
  return transformed(rigid_inverse(view.eye_from_world), {0, 0, 0});
}

}  // namespace

Matrix4 multiplied(const Matrix4& a, const Matrix4& b) {
  Matrix4 product{};
  for (std::size_t c = 0; c < 4; ++c) {
    for (std::size_t r = 0; r < 4; ++r) {
      float sum = 0;
      for (std::size_t k = 0; k < 4; ++k) {
        sum += a[4 * k + r] * b[4 * c + k];
      }
      product[4 * c + r] = sum;
    }
  }
  return product;
}

Float3 transformed(const Matrix4& m, Float3 p) {
  return {dot(row(m, 0), p) + m[12], dot(row(m, 1), p) + m[13], dot(row(m, 2), p) + m[14]};
}

Float3 transformed_back(const Matrix4& m, Float3 p) {
  // Columns and rows are those of a rotation times the scale: the inverse is the transpose over the
  // scale squared.
  const Float3 off = p - Float3{m[12], m[13], m[14]};
  return (1.0f / dot(row(m, 0), row(m, 0))) * Float3{dot({m[0], m[1], m[2]}, off),
                                                     dot({m[4], m[5], m[6]}, off),
                                                     dot({m[8], m[9], m[10]}, off)};
}

Matrix4 rigid_inverse(const Matrix4& m) {
  const Float3 translation = {m[12], m[13], m[14]};
  const Float3 x = {m[0], m[1], m[2]};
  const Float3 y = {m[4], m[5], m[6]};
  const Float3 z = {m[8], m[9], m[10]};
  return {x.x,
          y.x,
          z.x,
          0,
          x.y,
          y.y,
          z.y,
          0,
          x.z,
          y.z,
          z.z,
          0,
          -dot(x, translation),
          -dot(y, translation),
          -dot(z, translation),
          1};
}

Matrix4 clip_from_world(const View& view) {
  const float across = view.tan_left + view.tan_right;
  const float down = view.tan_up + view.tan_down;
  // For a point at (x, y, -d): x_clip / d runs from -1 at -tan_left to 1 at tan_right.
  Matrix4 projection{};
  projection[0] = 2 / across;
  projection[5] = -2 / down;
  projection[8] = (view.tan_right - view.tan_left) / across;
  projection[9] = (view.tan_down - view.tan_up) / down;
  projection[10] = -1;
  projection[11] = -1;
  projection[14] = -kNearPlane_m;
  return multiplied(projection, view.eye_from_world);
}

std::optional<PixelPoint> project(const View& view, Float3 in_world, int width_px, int height_px) {
  const Float3 p = transformed(view.eye_from_world, in_world);
  const float depth_m = -p.z;
  if (!(depth_m >= kNearPlane_m)) {
    return std::nullopt;
  }
  const float across = view.tan_left + view.tan_right;
  const float down = view.tan_up + view.tan_down;
  return PixelPoint{static_cast<float>(width_px) * (p.x / depth_m + view.tan_left) / across,
                    static_cast<float>(height_px) * (view.tan_up - p.y / depth_m) / down, depth_m};
}

Head head_of(const std::vector<View>& views) {
  Head head;
  if (views.empty()) {
    return head;
  }
  Float3 position;
  Float3 up;
  Float3 back;
  for (const View& view : views) {
    position = position + eye_position(view);
    up = up + row(view.eye_from_world, 1);
    back = back + row(view.eye_from_world, 2);
  }
  head.position = (1.0f / static_cast<float>(views.size())) * position;
  head.back = unit_or(back, {0, 0, 1});
  head.right = unit_or(cross(up, head.back), any_perpendicular(head.back));
  head.up = cross(head.back, head.right);
  return head;
}

View look_at(Float3 eye, Float3 target, Float3 up, float tan_across, float tan_up) {
  const Float3 back = unit_or(eye - target, {0, 0, 1});
  const Float3 right = unit_or(cross(up, back), any_perpendicular(back));
  const Float3 true_up = cross(back, right);
  View view;
  view.eye_from_world = {
      right.x, true_up.x, back.x, 0, right.y,          true_up.y,          back.y,          0,
      right.z, true_up.z, back.z, 0, -dot(right, eye), -dot(true_up, eye), -dot(back, eye), 1};
  view.tan_left = view.tan_right = tan_across;
  view.tan_up = view.tan_down = tan_up;
  return view;
}

std::vector<View> stereo_pair(const View& between, float eyes_apart_m) {
  std::vector<View> eyes = {between, between};
  eyes[0].eye_from_world[12] += 0.5f * eyes_apart_m;
  eyes[1].eye_from_world[12] -= 0.5f * eyes_apart_m;
  return eyes;
}

}  // namespace orthonav::render
