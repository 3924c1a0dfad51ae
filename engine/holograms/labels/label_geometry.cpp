#include "engine/holograms/labels/label_geometry.h"

#include <algorithm>
#include <optional>

namespace orthonav::engine {
namespace {

using render::Float3;

/// The direction of a point in front of the eye; z is its distance.
std::optional<Float3> seen(const render::Matrix4& eye_from_world, Float3 in_world) {
  const Float3 in_eye = render::transformed(eye_from_world, in_world);
  const float depth_m = -in_eye.z;
  if (!(depth_m > render::kNearPlane_m)) {
    return std::nullopt;
  }
  return Float3{in_eye.x / depth_m, in_eye.y / depth_m, depth_m};
}

/// Whether a line at right angles to (x, y) separates outline and box.
bool apart(const SeenOutline& outline, const SeenBox& box, float x, float y) {
  float least = 0;
  float most = 0;
  for (std::size_t i = 0; i < outline.count; ++i) {
    const float along = x * outline.corners[i].x + y * outline.corners[i].y;
    least = i == 0 ? along : std::min(least, along);
    most = i == 0 ? along : std::max(most, along);
  }
  const float low = x * (x > 0 ? box.left : box.right) + y * (y > 0 ? box.bottom : box.top);
  const float high = x * (x > 0 ? box.right : box.left) + y * (y > 0 ? box.top : box.bottom);
  return high <= least || low >= most;
}

}  // namespace

SeenBox grown(const SeenBox& box, float by) {
  return box.empty() ? box : SeenBox{box.left - by, box.bottom - by, box.right + by, box.top + by};
}

bool overlap(const SeenBox& a, const SeenBox& b) {
  return !a.empty() && !b.empty() && a.left < b.right && b.left < a.right && a.bottom < b.top &&
         b.bottom < a.top;
}

bool overlap(const SeenOutline& outline, const SeenBox& box) {
  if (outline.count == 0 || box.empty()) {
    return false;
  }
  const SeenBox around = grown(box, outline.radius);
  if (apart(outline, around, 1, 0) || apart(outline, around, 0, 1)) {
    return false;
  }
  for (std::size_t i = 0; outline.count > 1 && i < outline.count; ++i) {
    const SeenPoint a = outline.corners[i];
    const SeenPoint b = outline.corners[(i + 1) % outline.count];
    if (apart(outline, around, a.y - b.y, b.x - a.x)) {
      return false;
    }
  }
  return true;
}

bool overlap(const BoxInEyes& a, const BoxInEyes& b) {
  return overlap(a[0], b[0]) || overlap(a[1], b[1]);
}

bool overlap(const OutlineInEyes& outline, const BoxInEyes& box) {
  return overlap(outline[0], box[0]) || overlap(outline[1], box[1]);
}

BoxInEyes grown(const BoxInEyes& boxes, float by) {
  return {grown(boxes[0], by), grown(boxes[1], by)};
}

Eyes::Eyes(const std::vector<render::View>& views)
    : count_(std::min<std::size_t>(views.size(), 2)), head_(render::head_of(views)) {
  for (std::size_t i = 0; i < count_; ++i) {
    eye_from_world_[i] = views[i].eye_from_world;
    fields_[i] = {-views[i].tan_left, -views[i].tan_down, views[i].tan_right, views[i].tan_up};
  }
}

BoxInEyes Eyes::box(const render::Matrix4& world_from_caps, const CapsBox& box) const {
  const std::array<Float3, 4> corners = {
      render::transformed(world_from_caps, {box.left, box.bottom, 0}),
      render::transformed(world_from_caps, {box.right, box.bottom, 0}),
      render::transformed(world_from_caps, {box.right, box.top, 0}),
      render::transformed(world_from_caps, {box.left, box.top, 0})};
  return this->box(corners);
}

BoxInEyes Eyes::box(const std::array<Float3, 4>& corners) const {
  const OutlineInEyes outlines = outline(corners, 0);
  BoxInEyes boxes;
  for (std::size_t eye = 0; eye < count_; ++eye) {
    const SeenOutline& seen_outline = outlines[eye];
    for (std::size_t i = 0; i < seen_outline.count; ++i) {
      const SeenPoint p = seen_outline.corners[i];
      SeenBox& b = boxes[eye];
      b = i == 0 ? SeenBox{p.x, p.y, p.x, p.y}
                 : SeenBox{std::min(b.left, p.x), std::min(b.bottom, p.y), std::max(b.right, p.x),
                           std::max(b.top, p.y)};
    }
  }
  return boxes;
}

bool Eyes::in_view(const BoxInEyes& boxes) const {
  for (std::size_t eye = 0; eye < count_; ++eye) {
    const SeenBox& box = boxes[eye];
    const SeenBox& field = fields_[eye];
    if (!(!box.empty() && box.left >= field.left && box.bottom >= field.bottom &&
          box.right <= field.right && box.top <= field.top)) {
      return false;
    }
  }
  return true;
}

bool Eyes::in_view(Float3 in_world) const {
  return in_view(box(std::array<Float3, 4>{in_world, in_world, in_world, in_world}));
}

SeenBox Eyes::common_field() const {
  SeenBox common = fields_[0];
  if (count_ == 2) {
    common = {std::max(common.left, fields_[1].left), std::max(common.bottom, fields_[1].bottom),
              std::min(common.right, fields_[1].right), std::min(common.top, fields_[1].top)};
  }
  return common;
}

OutlineInEyes Eyes::outline(std::span<const Float3> corners, float radius_m) const {
  OutlineInEyes outlines;
  for (std::size_t eye = 0; eye < count_; ++eye) {
    SeenOutline& out = outlines[eye];
    for (const Float3 corner : corners.first(std::min<std::size_t>(corners.size(), 4))) {
      const auto at = seen(eye_from_world_[eye], corner);
      if (!at) {
        out = {};
        break;
      }
      out.corners[out.count++] = {at->x, at->y};
      out.radius = std::max(out.radius, radius_m / at->z);
    }
  }
  return outlines;
}

}  // namespace orthonav::engine
