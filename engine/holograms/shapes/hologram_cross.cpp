#include "engine/holograms/shapes/hologram_cross.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <span>

#include "base/translation.h"
#include "engine/holograms/shapes/hologram_parts.h"
#include "engine/session/text/wording.h"
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
constexpr float kArrow_m = 0.0040f;
constexpr float kWayWidth_m = 0.0009f;
constexpr float kLongestWay_m = 0.012f;
constexpr float kFairDash_m = 0.008f;
constexpr float kPoorDash_m = 0.003f;
/// A dot beyond this multiple of the outermost ring's radius is held at the rim.
constexpr float kRim = 1.12f;

// The rows under the rings, in heights of a base size: text keeps its visual angle, so it grows in
// the world with the distance.
constexpr float kBase_m = 0.0040f;
constexpr float kBase_deg = 0.4571f;
constexpr float kAngleSize = 1.75f;  // 0.8 degrees
constexpr float kRowSize = 1.25f;
constexpr float kAngleDown = 2.7f;
constexpr float kOffsetDown = 4.8f;
constexpr float kDepthDown = 6.9f;
constexpr float kWordUp = 0.9f;
constexpr float kAlarmSize = 2.2f;
constexpr float kWordSize = 1.0f;

constexpr float kBarBesideRim_m = 0.004f;
constexpr float kBarWidth_m = 0.004f;
constexpr float kBarWhileDrilling_m = 0.009f;
constexpr float kBarFrame_m = 0.0005f;

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

void add_dots(Scene& scene, const TargetCross& cross, const CrossPlaces& places, Label label) {
  const render::Colour colour = colour_of(cross.reading->grade);
  add_sphere(scene, places.dots[0], kDotRadius_m, colour, label);
  add_ring(scene, places.dots[1], places.normal, kHollowRadius_m, kHollowWidth_m, colour, label,
           24);
  if (!places.way) {
    return;
  }
  const auto& [from, to] = *places.way;
  const Float3 along = render::unit_or(to - from, places.up);
  const Float3 across = 0.45f * kArrow_m * render::cross(along, places.normal);
  const Float3 neck = to - kArrow_m * along;
  add_line(scene, {from, to}, kWayWidth_m, colour, label);
  add_line(scene, {neck + across, to, neck - across}, kWayWidth_m, colour, label);
}

/// The outermost ring tells the verdict, by its dashes too.
void add_rings(Scene& scene, const TargetCross& cross, const CrossPlaces& places, Label label) {
  // Without a tool there is nothing to read: only the outer ring shows what the words refer to.
  const std::span<const float> rings_m =
      cross.lost ? std::span(kCrossRings_m).last(1) : std::span(kCrossRings_m);
  for (const float ring_m : rings_m) {
    add_ring(scene, places.middle, places.normal, kCrossScale * ring_m, kRingWidth_m, look::kRing,
             label);
  }
  if (cross.reading) {
    constexpr std::array<float, 3> kDashes_m = {0.0f, kFairDash_m, kPoorDash_m};
    render::LineItem& outermost = scene.lines.back();
    outermost.colour = colour_of(cross.reading->grade);
    outermost.dash_m = kDashes_m[static_cast<std::size_t>(cross.reading->grade)];
    outermost.width_m = 2.0f * kRingWidth_m;
  }
}

/// A row that many base heights below the rings' foot, or above their top if negative.
render::TextItem& add_row(Scene& scene, const CrossPlaces& places, float down, float size,
                          Label label) {
  const float rim_m = kCrossScale * kCrossRings_m.back();
  render::TextItem& item = scene.texts.emplace_back();
  item.label = label;
  item.position = places.middle + (down > 0 ? -rim_m : rim_m) * places.up;
  item.offset_up = -down / size;
  item.height_m = size * kBase_m;
  item.min_height_deg = size * kBase_deg;
  return item;
}

/// The worst is white in a rim, the rest is plain.
std::string& add_number_run(render::TextItem& item, const CrossNumbers& numbers, bool worst) {
  if (worst) {
    item.rim = colour_of(numbers.grade);
  }
  return add_run(item, worst ? look::kWhite : look::kSoftWhite);
}

void add_bar(Scene& scene, const CrossPlaces& places, const CrossNumbers& numbers, Label label) {
  const float rim_m = kCrossScale * kCrossRings_m.back();
  const float width_m = numbers.drilling ? kBarWhileDrilling_m : kBarWidth_m;
  const Float3 half = 0.5f * width_m * places.right;
  const Float3 top =
      places.middle + rim_m * places.up + (rim_m + kBarBesideRim_m) * places.right + half;
  const Float3 foot = top - 2.0f * rim_m * places.up;
  add_line(scene, {top - half, top + half, foot + half, foot - half}, kBarFrame_m, look::kSoftWhite,
           label, 0, true);
  if (numbers.way > 0) {
    const Float3 end = top + numbers.way * (foot - top);
    const render::Colour colour = colour_of(numbers.grade);
    scene.triangles.push_back({label, {top - half, top + half, end + half}, colour});
    scene.triangles.push_back({label, {top - half, end + half, end - half}, colour});
  }
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
  std::array<Float3, 2> from_middle{};  // magnified
  for (std::size_t i = 0; i < offsets.size(); ++i) {
    const auto [across, up] = on_disc(cross, places.right, towards_eye, offsets[i]);
    const float rim_m = kCrossScale * kRim * kCrossRings_m.back();
    from_middle[i] = kCrossScale * (across * places.right + up * places.up);
    const bool within = render::length(from_middle[i]) <= rim_m;
    places.dots[i] = places.middle +
                     (within ? from_middle[i] : rim_m * render::unit_or(from_middle[i], places.up));
  }
  // The tip goes to the middle; the tool's axis is parallel once its dot is that of the tip.
  const Worst worst = cross.reading->worst;
  if (worst == Worst::kOffset || worst == Worst::kAngle) {
    const bool tip = worst == Worst::kOffset;
    const Float3 from = places.dots[tip ? 0 : 1];
    const Float3 way = tip ? -1.0f * from_middle[0] : from_middle[0] - from_middle[1];
    const float length_m = std::min(render::length(way), kLongestWay_m);
    places.way = {from, from + length_m * render::unit_or(way, places.up)};
  }
  return places;
}

void add_target_cross(Scene& scene, const TargetCross& cross, Label label) {
  const CrossPlaces places = places_of(cross);
  add_rings(scene, cross, places, label);
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
  for (render::LineItem& line : scene.lines) {
    if (is_cross(line)) {
      line.colour = look::kRing;
      line.width_m = kRingWidth_m;
      line.dash_m = 0;
    }
  }
  add_lost_text(scene, disc->middle, label);
}

void add_cross_numbers(Scene& scene, const TargetCross& cross, const CrossNumbers& numbers,
                       const CrossLabels& labels) {
  const CrossPlaces places = places_of(cross);
  render::TextItem& angle = add_row(scene, places, kAngleDown, kAngleSize, labels.angle);
  if (!numbers.sizes) {
    add_run(angle, "", look::kWhite);
    return take_angle_off(angle);
  }
  const bool unsure = numbers.worst == Worst::kCertainty;
  const auto is_worst = [&](Worst what, nav::Certainty certainty) {
    return numbers.worst == what || (unsure && certainty != nav::Certainty::kSure);
  };
  const nav::ScrewSizes& sizes = *numbers.sizes;
  append_angle(add_number_run(angle, numbers, is_worst(Worst::kAngle, sizes.angle.certainty)),
               sizes.angle);
  render::TextItem& offset = add_row(scene, places, kOffsetDown, kRowSize, labels.offset);
  append_offset(add_number_run(offset, numbers, is_worst(Worst::kOffset, sizes.offset.certainty)),
                sizes.offset);
  if (numbers.depth) {
    render::TextItem& depth = add_row(scene, places, kDepthDown, kRowSize, labels.depth);
    append_depth(add_number_run(depth, numbers, is_worst(Worst::kDepth, numbers.depth->certainty)),
                 *numbers.depth);
    add_bar(scene, places, numbers, labels.depth);
  }
}

void add_cross_word(Scene& scene, const TargetCross& cross, std::string_view word,
                    const render::Colour& rim, bool larger, Label label) {
  render::TextItem& item =
      add_row(scene, places_of(cross), -kWordUp, larger ? kAlarmSize : kWordSize, label);
  item.rim = rim;
  add_run(item, word, look::kWhite);
}

void add_tip_distance(Scene& scene, Float3 tip, double distance_m, Label label) {
  append_rounded_mm(add_run(add_text_beside(scene, tip, 2.0f, kBase_m, 0.5f, label), look::kWhite),
                    distance_m);
}

}  // namespace orthonav::engine
