#include "render/projection.h"

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "render/float3.h"

namespace orthonav::render {
namespace {

/// Of the rotation.
Float3 row(const Matrix4& m, int r) { return {m[0][r], m[1][r], m[2][r]}; }

Float3 eye_position(const View& view) {
  return transformed(rigid_inverse(view.eye_from_world), {0, 0, 0});
}

}  // namespace

Float3 transformed(const Matrix4& m, Float3 p) {
  return {dot(row(m, 0), p) + m[3].x, dot(row(m, 1), p) + m[3].y, dot(row(m, 2), p) + m[3].z};
}

Float3 transformed_back(const Matrix4& m, Float3 p) {
  // Columns and rows are those of a rotation times the scale: the inverse is the transpose over the
  // scale squared.
  const Float3 off = p - Float3(m[3]);
  return (1.0f / dot(row(m, 0), row(m, 0))) *
         Float3{dot(Float3(m[0]), off), dot(Float3(m[1]), off), dot(Float3(m[2]), off)};
}

Matrix4 rigid_inverse(const Matrix4& m) {
  const glm::mat3 back = glm::transpose(glm::mat3(m));
  Matrix4 inverse(back);
  for (int r = 0; r < 3; ++r) {
    inverse[3][r] = -dot(Float3(m[r]), Float3(m[3]));
  }
  return inverse;
}

Matrix4 clip_from_world(const View& view) {
  const float across = view.tan_left + view.tan_right;
  const float down = view.tan_up + view.tan_down;
  // For a point at (x, y, -d): x_clip / d runs from -1 at -tan_left to 1 at tan_right.
  const Matrix4 projection{
      {2 / across, 0, 0, 0},
      {0, -2 / down, 0, 0},
      {(view.tan_right - view.tan_left) / across, (view.tan_down - view.tan_up) / down, -1, -1},
      {0, 0, -kNearPlane_m, 0}};
  return projection * view.eye_from_world;
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
  Float3 position{};
  Float3 up{};
  Float3 back{};
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
  view.eye_from_world = {{right.x, true_up.x, back.x, 0},
                         {right.y, true_up.y, back.y, 0},
                         {right.z, true_up.z, back.z, 0},
                         {-dot(right, eye), -dot(true_up, eye), -dot(back, eye), 1}};
  view.tan_left = view.tan_right = tan_across;
  view.tan_up = view.tan_down = tan_up;
  return view;
}

std::vector<View> stereo_pair(const View& between, float eyes_apart_m) {
  std::vector<View> eyes = {between, between};
  eyes[0].eye_from_world[3].x += 0.5f * eyes_apart_m;
  eyes[1].eye_from_world[3].x -= 0.5f * eyes_apart_m;
  return eyes;
}

}  // namespace orthonav::render
