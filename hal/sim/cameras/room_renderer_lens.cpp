#include "hal/sim/cameras/room_renderer_lens.h"

#include <algorithm>
#include <cmath>

#include "hal/api/lookup_cell.h"

namespace orthonav::sim {

CameraLens::CameraLens(const CameraModel& camera) : camera_(camera) {
  const int column = camera.width_px() / 2;
  const int row = camera.height_px() / 2;
  const Vec2 here = camera.lookup()[index(column, row)];
  const Vec2 right = camera.lookup()[index(column - 1, row)];
  const Vec2 below = camera.lookup()[index(column, row - 1)];
  centre_ray_ = is_nan(here) ? Vec2{} : here;
  const Vec2 step{here.x - right.x, here.y - below.y};
  // Even a camera without a direction in its centre needs a scale; only the appearance depends on
  // it.
  const bool usable = !is_nan(step) && step.x != 0.0 && step.y != 0.0;
  scale_px_ = usable ? Vec2{1.0 / step.x, 1.0 / step.y}
                     : Vec2{0.5 * camera.width_px(), 0.5 * camera.height_px()};
  focal_px_ = 0.5 * (std::abs(scale_px_.x) + std::abs(scale_px_.y));
}

/// The centre of the pixel that lies in the middle, or just behind it.
static double middle_of(int length_px) {
  const int half_px = length_px / 2;
  return half_px + 0.5;
}

Vec2 CameraLens::linear(Vec2 u) const {
  return {middle_of(camera_.width_px()) + scale_px_.x * (u.x - centre_ray_.x),
          middle_of(camera_.height_px()) + scale_px_.y * (u.y - centre_ray_.y)};
}

Vec2 CameraLens::pixel(Vec3 p) const {
  const Vec2 u{p.x / p.z, p.y / p.z};
  if (const auto exact = camera_.project(u)) {
    return *exact;
  }
  return rough_pixel(p);
}

Vec2 CameraLens::rough_pixel(Vec3 p) const {
  const Vec2 u{p.x / p.z, p.y / p.z};
  const Vec2 start = linear(u);
  Vec2 pixel = start;
  // Each step corrects by what the table says at the nearest centre, with the derivative of the
  // image's middle; distortion changes that by a few per cent, so two steps leave 0.1 px.
  for (int i = 0; i < 2; ++i) {
    const int column =
        std::clamp(static_cast<int>(std::clamp(pixel.x, 0.0, 1e6)), 0, camera_.width_px() - 1);
    const int row =
        std::clamp(static_cast<int>(std::clamp(pixel.y, 0.0, 1e6)), 0, camera_.height_px() - 1);
    const Vec2 there = camera_.lookup()[index(column, row)];
    if (is_nan(there)) {
      return start;
    }
    pixel = {column + 0.5 + scale_px_.x * (u.x - there.x),
             row + 0.5 + scale_px_.y * (u.y - there.y)};
  }
  return pixel;
}

PinholeLens::PinholeLens(const PinholeView& view, int width_px, int height_px)
    : width_px_(width_px),
      height_px_(height_px),
      scale_{width_px / (view.tan_left + view.tan_right),
             height_px / (view.tan_up + view.tan_down)},
      centre_{view.tan_left * scale_.x, view.tan_up * scale_.y} {}

}  // namespace orthonav::sim
