#include "render/frame/screen_bounds.h"

#include <cmath>
#include <limits>

#include "render/projection.h"

namespace orthonav::render {
namespace {

constexpr float kLeastRadius_px = 0.75f;  // as line.vert has it
constexpr float kSlack_px = 2.0f;         // for rounding here and on the device
constexpr int kGrid_px = 16;              // regions are aligned with rasterizers' blocks

int rounded_down(float value_px) {
  return static_cast<int>(std::floor((value_px - kSlack_px) / kGrid_px)) * kGrid_px;
}
int rounded_up(float value_px) {
  return static_cast<int>(std::ceil((value_px + kSlack_px) / kGrid_px)) * kGrid_px;
}

}  // namespace

Box box_of(const MeshData& mesh) {
  if (mesh.positions.empty()) {
    return {};
  }
  Box box{mesh.positions.front(), mesh.positions.front()};
  for (const Float3 p : mesh.positions) {
    box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y), std::min(box.low.z, p.z)};
    box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y), std::max(box.high.z, p.z)};
  }
  return box;
}

ScreenBounds::ScreenBounds(std::span<const View> views, int width_px, int height_px)
    : views_(views.size()),
      width_px_(static_cast<float>(width_px)),
      height_px_(static_cast<float>(height_px)) {
  for (std::size_t i = 0; i < views_; ++i) {
    clip_from_world_[i] = clip_from_world(views[i]);
    scale_px_[i] = height_px_ / (views[i].tan_up + views[i].tan_down);
  }
  clear();
}

void ScreenBounds::clear() {
  constexpr float kMost = std::numeric_limits<float>::max();
  extents_.fill({kMost, kMost, -kMost, -kMost, false, false});
}

void ScreenBounds::add(Float3 in_world) {
  for (std::size_t i = 0; i < views_; ++i) {
    add_to_view(i, in_world, 0, 0);
  }
}

void ScreenBounds::add_disc(Float3 in_world, float radius_m) {
  for (std::size_t i = 0; i < views_; ++i) {
    add_to_view(i, in_world, radius_m, kLeastRadius_px);
  }
}

void ScreenBounds::add_box(const Matrix4& world_from_box, const Box& box) {
  for (unsigned corner = 0; corner < 8; ++corner) {
    add(transformed(world_from_box,
                    {corner & 1u ? box.high.x : box.low.x, corner & 2u ? box.high.y : box.low.y,
                     corner & 4u ? box.high.z : box.low.z}));
  }
}

void ScreenBounds::add_to_view(std::size_t view, Float3 p, float radius_m, float least_px) {
  Extent& extent = extents_[view];
  const Float4 clip = clip_from_world_[view] * Float4(p, 1);
  const float depth = clip.w;
  // A point close to the plane counts as both in front of and behind it, so that rounding can't
  // lose it.
  extent.in_front |= depth > 0.99f * kNearPlane_m;
  extent.behind |= depth < 1.01f * kNearPlane_m;
  if (extent.behind) {
    return;
  }
  const float x_px = (0.5f * clip.x / depth + 0.5f) * width_px_;
  const float y_px = (0.5f * clip.y / depth + 0.5f) * height_px_;
  const float radius_px = std::max(radius_m * scale_px_[view] / depth, least_px);
  extent.left = std::min(extent.left, x_px - radius_px);
  extent.right = std::max(extent.right, x_px + radius_px);
  extent.top = std::min(extent.top, y_px - radius_px);
  extent.bottom = std::max(extent.bottom, y_px + radius_px);
}

PixelRect ScreenBounds::rect_in(const Extent& extent) const {
  if (!extent.in_front) {
    return {};
  }
  const PixelRect whole{0, 0, static_cast<int>(width_px_), static_cast<int>(height_px_)};
  if (extent.behind) {
    return whole;
  }
  // Clamped before rounding: a point far off to the side would overflow an integer.
  const auto within = [](float value, float most) { return std::clamp(value, -64.0f, most + 64); };
  const PixelRect rect{std::max(rounded_down(within(extent.left, width_px_)), 0),
                       std::max(rounded_down(within(extent.top, height_px_)), 0),
                       std::min(rounded_up(within(extent.right, width_px_)), whole.right),
                       std::min(rounded_up(within(extent.bottom, height_px_)), whole.bottom)};
  return rect.empty() ? PixelRect{} : rect;
}

PixelRect ScreenBounds::rect() const {
  PixelRect rect;
  for (std::size_t i = 0; i < views_; ++i) {
    rect = joined(rect, rect_in(extents_[i]));
  }
  return rect;
}

}  // namespace orthonav::render
