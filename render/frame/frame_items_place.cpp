#include "render/frame/frame_items.h"

namespace orthonav::render {

PixelRect FrameItems::bounds_of(const SpanDraw& draw, std::uint32_t points,
                                ScreenBounds& bounds) const {
  bounds.clear();
  for (std::uint32_t i = draw.first; i < draw.first + points; ++i) {
    const Float4& p = data_[i];
    bounds.add_disc({p.x, p.y, p.z}, 0.5f * draw.width_m);
  }
  return bounds.rect();
}

PixelRect FrameItems::bounds_of(const TextDraw& draw, ScreenBounds& bounds) const {
  Box box{{data_[draw.first].x, data_[draw.first].y, 0}, {data_[draw.first].z, 0, 0}};
  for (std::uint32_t glyph = 0; glyph < draw.count; ++glyph) {
    const Float4& rectangle = data_[draw.first + 3 * glyph];
    box.low = {std::min(box.low.x, rectangle.x), std::min(box.low.y, rectangle.y), 0};
    box.high = {std::max(box.high.x, rectangle.z), std::max(box.high.y, rectangle.w), 0};
  }
  bounds.clear();
  bounds.add_box(draw.world_from_caps, box);
  return bounds.rect();
}

void FrameItems::place(std::span<const View> views, PixelSize size, const BoxOf& box_of) {
  ScreenBounds bounds(views, size.width_px, size.height_px);
  regions_.clear();
  for (auto* meshes : {&translucent_meshes_, &solids_}) {
    for (MeshDraw& draw : *meshes) {
      bounds.clear();
      bounds.add_box(draw.item->world_from_model, box_of(*draw.item));
      draw.bounds = bounds.rect();
      add_region(regions_, draw.bounds);
    }
  }
  for (SpanDraw& draw : triangles_) {
    draw.bounds = bounds_of(draw, draw.count, bounds);
    add_region(regions_, draw.bounds);
  }
  for (SpanDraw& draw : lines_) {
    draw.bounds = bounds_of(draw, 2 * draw.count, bounds);
    add_region(regions_, draw.bounds);
  }
  for (TextDraw& draw : texts_) {
    draw.bounds = bounds_of(draw, bounds);
    add_region(regions_, draw.bounds);
  }
}

}  // namespace orthonav::render
