#include "render/frame/hidden_edges.h"

#include <algorithm>
#include <span>

#include "render/float3.h"

namespace orthonav::render {
namespace {

float height(const Float4& plane, Float3 p) {
  return plane.x * p.x + plane.y * p.y + plane.z * p.z + plane.w;
}

/// Parts of a segment's length; nothing if they are in the wrong order.
struct HiddenPart {
  float begin = 0;
  float end = 1;
};

/// The part that lies behind all planes (Cyrus & Beck 1978).
HiddenPart hidden_part(std::span<const Float4> planes, const Matrix4& world_from_model,
                       const Segment3& in_world) {
  const Segment3 s = {transformed_back(world_from_model, in_world.from),
                      transformed_back(world_from_model, in_world.to)};
  HiddenPart part;
  for (const Float4& plane : planes) {
    const float from = height(plane, s.from);
    const float to = height(plane, s.to);
    if (from > 0 && to > 0) {
      return {1, 0};
    }
    if (from > 0) {
      part.begin = std::max(part.begin, from / (from - to));
    } else if (to > 0) {
      part.end = std::min(part.end, from / (from - to));
    }
  }
  return part;
}

Float3 between(const Segment3& s, float part) { return s.from + part * (s.to - s.from); }

}  // namespace

bool HiddenEdges::Hiding::may_hide(const PlacedSurface& other, const Float4& at_px) const {
  return surface.item != other.item && (other.veil || !surface.veil) &&
         std::max(at_px.x, at_px.z) > box_px.x && std::max(at_px.y, at_px.w) > box_px.y &&
         std::min(at_px.x, at_px.z) < box_px.z && std::min(at_px.y, at_px.w) < box_px.w;
}

void HiddenEdges::clear() {
  surfaces_.clear();
  planes_.clear();
}

void HiddenEdges::add(const PlacedSurface& surface, const Float4& box_px) {
  surfaces_.push_back({surface, box_px, planes_.size(), 0});
}

void HiddenEdges::add_plane(const Float4& plane) {
  planes_.push_back(plane);
  ++surfaces_.back().planes;
}

bool HiddenEdges::may_hide(const PlacedSurface& surface, const Float4& at_px) const {
  return std::any_of(surfaces_.begin(), surfaces_.end(),
                     [&](const Hiding& hiding) { return hiding.may_hide(surface, at_px); });
}

void HiddenEdges::leave_out(const PlacedSurface& surface, const Float4& at_px,
                            std::vector<Segment3>& shown) const {
  for (const Hiding& hiding : surfaces_) {
    if (hiding.may_hide(surface, at_px)) {
      leave_out(hiding, shown);
    }
  }
}

void HiddenEdges::leave_out(const Hiding& hiding, std::vector<Segment3>& shown) const {
  const std::size_t count = shown.size();
  for (std::size_t i = 0; i < count; ++i) {
    const Segment3 whole = shown[i];
    const HiddenPart hidden = hidden_part({planes_.data() + hiding.first_plane, hiding.planes},
                                          hiding.surface.world_from_model, whole);
    if (!(hidden.begin < hidden.end)) {
      continue;
    }
    shown[i].to = between(whole, hidden.begin);
    if (hidden.end < 1) {
      shown.push_back({between(whole, hidden.end), whole.to});
    }
  }
  std::erase_if(shown, [](const Segment3& s) { return s.from == s.to; });
}

}  // namespace orthonav::render
