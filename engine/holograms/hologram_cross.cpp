#include "engine/holograms/hologram_cross.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <span>

#include "base/translation.h"
#include "engine/holograms/hologram_parts.h"
#include "engine/session/wording.h"
#include "render/float3.h"

namespace orthonav::engine {
namespace {

using render::Float3;
using render::Label;
using render::Scene;

constexpr float kRingWidth_m = 0.0005f;
constexpr float kDotRadius_m = 0.0014f;
constexpr float kHollowRadius_m = 0.0021f;
constexpr float kHollowWidth_m = 0.0007f;
constexpr float kArrow_m = 0.0030f;
/// A dot beyond this multiple of the outermost ring's radius is held at the rim.
constexpr float kRim = 1.12f;
constexpr float kDiagonal = 0.70710678f;

/// From a place to the eyes, unit.
Float3 towards(const Viewer& viewer, Float3 place) {
  return render::unit_or(viewer.eye - place, {0, 1, 0});
}

/// To the right as eyes in that direction see it, unit.
Float3 right_of(const Viewer& viewer, Float3 towards_eye) {
  return render::unit_or(render::cross(viewer.up, towards_eye),
                         render::any_perpendicular(towards_eye));
}

/// The offset from the planned axis as the eyes see it on the disc: across and up.
std::array<float, 2> on_disc(const TargetCross& cross, Float3 right, Float3 towards_eye,
                             Float3 offset) {
  const Float3 axis = dot(cross.outward, towards_eye) < 0 ? -1.0f * cross.outward : cross.outward;
  const Float3 across =
      render::unit_or(right - dot(right, axis) * axis, render::any_perpendicular(axis));
  return {dot(offset, across), dot(offset, render::cross(axis, across))};
}

/// A small triangle that points off the disc.
std::array<Float3, 3> arrow(const CrossPlaces& places, std::size_t i) {
  const Float3 side = render::cross(places.towards[i], places.normal);
  return {places.dots[i] + kArrow_m * places.towards[i], places.dots[i] + 0.6f * kArrow_m * side,
          places.dots[i] - 0.6f * kArrow_m * side};
}

void add_dots(Scene& scene, const TargetCross& cross, const CrossPlaces& places, Label label) {
  const render::Colour colour = colour_of(cross.reading->grade);
  if (places.outside[0]) {
    scene.triangles.push_back({label, arrow(places, 0), colour});
  } else {
    add_sphere(scene, places.dots[0], kDotRadius_m, colour, label);
  }
  if (places.outside[1]) {
    add_line(scene, arrow(places, 1), kHollowWidth_m, colour, label, 0, true);
  } else {
    add_ring(scene, places.dots[1], places.normal, kHollowRadius_m, kHollowWidth_m, colour, label,
             24);
  }
}

/// Alternately on the right and on the left, otherwise 1 and 2 would read as 12.
void add_ring_text(Scene& scene, const CrossPlaces& places, float ring_m, Label label) {
  char text[16];
  std::snprintf(text, sizeof(text), ring_m == kCrossRings_m.back() ? "%.0f mm" : "%.0f",
                static_cast<double>(ring_m) * 1e3);
  const float side = ring_m == kCrossRings_m[1] ? -1.0f : 1.0f;
  const Float3 place =
      places.middle + kDiagonal * kCrossScale * ring_m * (side * places.right - places.up);
  add_run(add_text_beside(scene, place, 0.25f * side, 0.0030f, 0.5f, label), text,
          look::kSoftWhite);
}

void add_lost_text(Scene& scene, Float3 middle, Label label) {
  render::TextItem& text = scene.texts.emplace_back();
  text.label = label;
  text.position = middle;
  text.offset_up = -0.5f;
  text.height_m = 0.0045f;
  text.min_height_deg = 0.5f;
  text.rim = look::colours().poor;
  add_run(text, translated(words::kToolLost), look::kWhite);
}

}  // namespace

LabelSide clear_side(Float3 site, Float3 outward, const Viewer& viewer, LabelSide until_now) {
  constexpr float kLeans = 0.15f;
  const float lean = dot(outward, right_of(viewer, towards(viewer, site)));
  if (!(std::abs(lean) > kLeans)) {
    return until_now;
  }
  return lean > 0 ? LabelSide::kLeft : LabelSide::kRight;
}

CrossPlaces places_of(const TargetCross& cross) {
  CrossPlaces places;
  const Float3 from_site = towards(cross.viewer, cross.site);
  const Float3 right = right_of(cross.viewer, from_site);
  const float aside_m = cross.side == LabelSide::kLeft ? -kCrossAside_m : kCrossAside_m;
  places.middle = cross.site + kCrossAbove_m * render::cross(from_site, right) + aside_m * right;
  const Float3 towards_eye = towards(cross.viewer, places.middle);
  places.right = right_of(cross.viewer, towards_eye);
  places.up = render::cross(towards_eye, places.right);
  places.normal = render::cross(places.right, places.up);
  places.dots.fill(places.middle);
  if (!cross.reading) {
    return places;
  }
  const std::array<Float3, 2> offsets = {cross.reading->tip_offset, cross.reading->top_offset};
  for (std::size_t i = 0; i < offsets.size(); ++i) {
    const auto [across, up] = on_disc(cross, places.right, towards_eye, offsets[i]);
    const float away = std::hypot(across, up);
    const float rim = kRim * kCrossRings_m.back();
    places.outside[i] = !(away <= rim);
    const Float3 from_middle = across * places.right + up * places.up;
    places.towards[i] = render::unit_or(from_middle, places.up);
    places.dots[i] =
        places.middle + kCrossScale * (places.outside[i] ? rim * places.towards[i] : from_middle);
  }
  return places;
}

void add_target_cross(Scene& scene, const TargetCross& cross, Label label) {
  const CrossPlaces places = places_of(cross);
  // Without a tool there is nothing to read: only the outer ring shows what the words refer to.
  const std::span<const float> rings_m =
      cross.lost ? std::span(kCrossRings_m).last(1) : std::span(kCrossRings_m);
  for (const float ring_m : rings_m) {
    add_ring(scene, places.middle, places.normal, kCrossScale * ring_m, kRingWidth_m, look::kRing,
             label);
    if (!cross.lost) {
      add_ring_text(scene, places, ring_m, label);
    }
  }
  if (cross.lost) {
    add_lost_text(scene, places.middle, label);
  } else if (cross.reading) {
    add_dots(scene, cross, places, label + 1);
  }
}

std::optional<CrossDisc> disc_of(const Scene& scene, Label label) {
  CrossDisc disc;
  for (const render::LineItem& line : scene.lines) {
    if (line.label == label) {
      disc.ring = &line;  // the last one is the outermost
    }
  }
  if (!disc.ring || disc.ring->points.empty()) {
    return std::nullopt;
  }
  const std::vector<Float3>& points = disc.ring->points;
  for (const Float3 point : points) {
    disc.middle = disc.middle + 1.0f / static_cast<float>(points.size()) * point;
  }
  disc.radius_m = render::length(points.front() - disc.middle);
  return disc;
}

void take_dots_off(Scene& scene, Label label) {
  const auto is_dot = [&](const auto& item) { return item.label == label + 1; };
  scene.meshes.erase_if(is_dot);
  scene.lines.erase_if(is_dot);
  scene.triangles.erase_if(is_dot);
  const auto is_cross = [&](const auto& item) { return item.label == label; };
  scene.texts.erase_if(is_cross);
  const std::optional<CrossDisc> disc = disc_of(scene, label);
  if (!disc) {
    return;
  }
  scene.lines.erase_if(
      [&](const render::LineItem& line) { return is_cross(line) && &line != disc->ring; });
  add_lost_text(scene, disc->middle, label);
}

void add_depth(Scene& scene, Float3 a, Float3 b, const nav::ShownDepth& depth, Label label) {
  const float size = depth.sure ? 1.0f : kUnsureSize;
  render::TextItem& item = scene.texts.emplace_back();
  item.label = label;
  item.position = readout_place(a, b);
  item.align = render::TextAlign::kLeft;
  // Under the angle; like the angle it shrinks no further than to the smallest legible height.
  item.offset_right = 1.6f / size;
  item.offset_up = -kDepthBelowAngle;
  item.height_m = size * 0.004f;
  item.min_height_deg = size * 0.45f;
  if (depth.to == nav::DepthTo::kPastTarget) {
    item.rim = look::colours().poor;
  }
  append_depth(add_run(item, depth.sure ? look::kWhite : look::kPale), depth);
}

}  // namespace orthonav::engine
