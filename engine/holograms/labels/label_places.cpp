#include "engine/holograms/labels/label_places.h"

#include <array>
#include <cmath>

#include "engine/holograms/shapes/hologram_label.h"

namespace orthonav::engine {
namespace {

using render::TextAlign;
using render::TextItem;

/// From the middle of the named object, for a label whose own side is the right.
struct Direction2 {
  float across;
  float up;
};
constexpr std::array<Direction2, 8> kAround = {
    {{1, 0}, {1, 1}, {1, -1}, {0, 1}, {0, -1}, {-1, 0}, {-1, 1}, {-1, -1}}};
constexpr std::array<float, 5> kFartherOff = {0.0f, 2.2f, 4.8f, 8.0f, 12.0f};
constexpr float kDiagonally = 0.8f;

TextAlign align_for(float across) {
  return across > 0 ? TextAlign::kLeft : (across < 0 ? TextAlign::kRight : TextAlign::kCentre);
}

/// Puts its near edge, corner or end at a distance from the middle of the object it names.
LabelPlace around(const TextItem& as_built, const LabelExtent& extent, std::size_t place) {
  const bool mirrored = as_built.align == TextAlign::kRight;
  const float beside =
      as_built.align == TextAlign::kCentre ? 1.6f : std::abs(as_built.offset_right);
  const std::size_t ring = place / kAround.size();
  Direction2 to = kAround[place % kAround.size()];
  to.across *= mirrored ? -1.0f : 1.0f;
  const bool diagonal = to.across != 0 && to.up != 0;
  const float away = (beside + kFartherOff[ring]) * (diagonal ? kDiagonally : 1.0f);
  LabelPlace at;
  at.align = align_for(to.across);
  at.right = to.across * away;
  at.up = -0.5f;
  if (to.up > 0) {
    at.up = away + extent.below;
  } else if (to.up < 0) {
    at.up = -away - extent.above;
  }
  at.led = ring > 0;
  return at;
}

}  // namespace

LabelRank rank_of(const TextItem& text) {
  if (text.place == render::TextPlace::kView) {
    return LabelRank::kFixed;
  }
  switch (kind_of(text.label)) {
    case HologramKind::kCheckPoint:
    case HologramKind::kTrajectory:
      return LabelRank::kMeasured;
    case HologramKind::kRod:
      // The length is at the rod's end, the bends are beside it.
      return text.align == TextAlign::kCentre ? LabelRank::kMeasured : LabelRank::kIncidental;
    case HologramKind::kEntry:
      return LabelRank::kNamed;
    case HologramKind::kAngle:
      // Beside the triangle, where there is no cross; else under that.
      return instance_of(text.label) == 1 ? LabelRank::kFixed : LabelRank::kMeasured;
    case HologramKind::kDepth:
      // The tip's distance from the entry; the depth is written under the cross.
      return instance_of(text.label) == 1 ? LabelRank::kFixed : LabelRank::kMeasured;
    default:  // where it was placed, it stays
      return LabelRank::kFixed;
  }
}

CapsBox box_at(const LabelPlace& place, const LabelExtent& extent) {
  const float left = place.align == TextAlign::kLeft     ? place.right
                     : place.align == TextAlign::kCentre ? place.right - 0.5f * extent.width
                                                         : place.right - extent.width;
  return {left - extent.aside, place.up - extent.below, left + extent.width + extent.aside,
          place.up + extent.above};
}

std::size_t count_of_places() { return 1 + kAround.size() * kFartherOff.size(); }

LabelPlace place_of(const TextItem& as_built, const LabelExtent& extent, std::size_t place) {
  if (place == 0) {
    return {as_built.align, as_built.offset_right, as_built.offset_up, false, true};
  }
  return around(as_built, extent, place - 1);
}

}  // namespace orthonav::engine
