#include "tests/engine/holograms/operating_field.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>

#include "engine/holograms/shapes/hologram_label.h"
#include "engine/holograms/shapes/hologram_shapes.h"
#include "engine/holograms/shapes/hologram_status.h"
#include "render/float3.h"
#include "render/frame/frame_items.h"

namespace orthonav::test {
namespace {

using engine::HologramKind;
using engine::label_of;
using render::Float3;

constexpr float kLevelApart_m = 0.034f;
constexpr float kAside_m = 0.0165f;
constexpr float kRing_m = 0.0033f;
constexpr float kPaper_m = 0.052f;  // half of a guide's tag of 80 mm with its margin
constexpr int kWidth_px = 2000;
constexpr int kHeight_px = 1500;

void add_status(OperatingField& field, const std::string& text) {
  const std::array<engine::ToolDot, 2> tools = {
      {{engine::ToolState::kMeasured}, {engine::ToolState::kPredicted}}};
  engine::add_status_line(field.scene, text, tools, label_of(HologramKind::kStatus, 1));
}

Float3 entry_of(int level, int side) {
  const auto z = static_cast<float>(level) * -kLevelApart_m;
  // A lumbar spine is curved, and wider farther down.
  return {static_cast<float>(side) * (kAside_m + 0.001f * static_cast<float>(level)),
          0.030f + 0.002f * static_cast<float>(level % 3), z};
}

/// Upright above B, facing the feet, as it is held.
engine::GlarePatch paper_above(Float3 b) {
  return {b + Float3{-kPaper_m, -0.002f, 0}, b + Float3{kPaper_m, -0.002f, 0},
          b + Float3{kPaper_m, 2 * kPaper_m, 0}, b + Float3{-kPaper_m, 2 * kPaper_m, 0}};
}

/// Rectangles of ink, in pixels.
struct Ink {
  std::string text;
  HologramKind kind = HologramKind::kPath;
  float left = 1e9f;
  float top = 1e9f;
  float right = -1e9f;
  float bottom = -1e9f;
  void add(const render::PixelPoint& p) {
    left = std::min(left, p.x_px);
    right = std::max(right, p.x_px);
    top = std::min(top, p.y_px);
    bottom = std::max(bottom, p.y_px);
  }
  [[nodiscard]] float away(const render::PixelPoint& p) const {
    return std::hypot(std::max({left - p.x_px, 0.0f, p.x_px - right}),
                      std::max({top - p.y_px, 0.0f, p.y_px - bottom}));
  }
  [[nodiscard]] bool covers(const Ink& other) const {
    return left < other.right && other.left < right && top < other.bottom && other.top < bottom;
  }
};

std::optional<render::PixelPoint> pixel(const render::View& view, Float3 at) {
  return render::project(view, at, kWidth_px, kHeight_px);
}

std::optional<Ink> ink_of(const render::TextItem& item, const render::Head& head,
                          const render::View& view) {
  static const render::Font font;
  std::vector<render::PlacedGlyph> glyphs;
  render::lay_out(font, item, glyphs);
  if (glyphs.empty()) {
    return std::nullopt;
  }
  const render::Matrix4 place = render::world_from_caps(item, head);
  Ink ink;
  ink.kind = engine::kind_of(item.label);
  for (const render::TextRun& run : item.runs) {
    ink.text += run.text;
  }
  for (const render::PlacedGlyph& glyph : glyphs) {
    const float reach = font.header().reach - (item.rim.a > 0 ? render::kRimWidth : 0);
    for (const float x : {glyph.left + reach, glyph.right - reach}) {
      for (const float y : {glyph.bottom + reach, glyph.top - reach}) {
        const auto at = pixel(view, render::transformed(place, {x, y, 0}));
        if (!at) {
          return std::nullopt;
        }
        ink.add(*at);
      }
    }
  }
  return ink;
}

bool over_paper(const Ink& ink, const engine::GlarePatch& paper, const render::View& view) {
  constexpr int kSteps = 40;
  for (int i = 0; i <= kSteps * kSteps; ++i) {
    const auto u = static_cast<float>(i % kSteps) / kSteps;
    const auto v = static_cast<float>(i / kSteps) / kSteps;
    const auto at = pixel(view, paper[0] + u * (paper[1] - paper[0]) + v * (paper[3] - paper[0]));
    if (at && ink.away(*at) == 0) {
      return true;
    }
  }
  return false;
}

void find_faults(const OperatingField& field, const std::vector<Ink>& inks,
                 const render::View& view, std::vector<std::string>& found) {
  const float pixels_at_1m = kHeight_px / (view.tan_up + view.tan_down);
  for (std::size_t i = 0; i < inks.size(); ++i) {
    const Ink& ink = inks[i];
    for (std::size_t k = i + 1; k < inks.size(); ++k) {
      if (ink.covers(inks[k])) {
        found.push_back(ink.text + " over " + inks[k].text);
      }
    }
    const bool guides = ink.kind == HologramKind::kAngle || ink.kind == HologramKind::kDepth ||
                        (ink.kind == HologramKind::kNumbers);
    for (const NamedPlace& place : field.places) {
      const auto at = pixel(view, place.at);
      if (at && (guides || !place.wound) && ink.kind != HologramKind::kStatus &&
          ink.away(*at) < place.radius_m * pixels_at_1m / at->depth_m) {
        found.push_back(ink.text + " over the place of " + place.name);
      }
    }
    for (const engine::GlarePatch& paper : field.papers) {
      if ((guides || ink.kind == HologramKind::kStatus) && over_paper(ink, paper, view)) {
        found.push_back(ink.text + " over paper");
      }
    }
  }
}

}  // namespace

OperatingField entry_points(int levels) {
  OperatingField field;
  std::size_t k = 0;
  for (int level = 0; level < levels; ++level) {
    for (const int side : {1, -1}) {
      const bool left = side > 0;
      const std::string name = "L" + std::to_string(level + 1) + (left ? " left" : " right");
      const Float3 at = entry_of(level, side);
      ++k;
      engine::add_entry(field.scene,
                        {at,
                         {0.25f * static_cast<float>(side), 0.95f, 0.15f},
                         name,
                         k % 2 == 0,
                         left ? engine::LabelSide::kLeft : engine::LabelSide::kRight},
                        label_of(HologramKind::kEntry, k));
      field.places.push_back({name, at, kRing_m, false});
    }
  }
  add_status(field, "landmark L4 | touch it");
  return field;
}

OperatingField guided_levels(int levels, float lean_rad) {
  OperatingField field = entry_points(levels);
  const Float3 a = entry_of(0, 1);
  const Float3 target = a + Float3{-0.008f, -0.043f, -0.003f};
  const Float3 planned = render::unit_or(a - target, {});
  const Float3 side = render::unit_or(render::cross({0, 0, 1}, planned), {});
  const Float3 b = a + 0.080f * (std::cos(lean_rad) * planned + std::sin(lean_rad) * side);
  engine::add_planned_trajectory(field.scene, a, target, label_of(HologramKind::kTrajectory, 1));
  engine::add_deviation_triangle(field.scene, a, b, a + 0.080f * planned, engine::Grade::kFair,
                                 label_of(HologramKind::kTriangle, 1));
  field.places.push_back({"the wound", a, 0.010f, true});
  field.papers.push_back(paper_above(b));
  return field;
}

OperatingField rods(int heads) {
  OperatingField field;
  for (const int side : {1, -1}) {
    std::vector<Float3> places;
    std::vector<engine::RodBendMark> bends;
    float length_m = 0;
    for (int i = 0; i < heads; ++i) {
      const Float3 head = entry_of(i, side) + Float3{0, 0.012f, 0};
      if (!places.empty()) {
        length_m += render::length(head - places.back());
        const Float3 middle = 0.5f * (head + places.back());
        bends.push_back({middle, 0.1, static_cast<double>(length_m)});
      }
      places.push_back(head);
      field.places.push_back({"head " + std::to_string(i), head, 0.0042f, false});
    }
    engine::RodHologram rod;
    rod.heads = places;
    rod.bends = bends;
    rod.length_m = static_cast<double>(length_m);
    engine::add_rod(field.scene, rod, label_of(HologramKind::kRod, side > 0 ? 1 : 2));
  }
  add_status(field, "rod right | touch the next head");
  return field;
}

OperatingField checked_places(int count) {
  OperatingField field;
  for (int i = 0; i < count; ++i) {
    const auto angle_rad = 2.4f * static_cast<float>(i);
    const float away_m = 0.008f * std::sqrt(static_cast<float>(i));
    const Float3 at{away_m * std::cos(angle_rad), 0.04f, away_m * std::sin(angle_rad)};
    engine::add_check_point(field.scene, at, "0." + std::to_string(i) + " mm", i % 3 != 0,
                            label_of(HologramKind::kCheckPoint, static_cast<std::size_t>(i + 1)));
    field.places.push_back({"check " + std::to_string(i + 1), at, 0.0020f, false});
  }
  add_status(field, "verify L4 | passed: say accept result");
  return field;
}

std::vector<render::View> head_at(float left_m, float above_m, float roll_rad) {
  const Float3 looked{0, 0.045f, -0.05f};
  const Float3 eye = looked + Float3{left_m, above_m, -0.25f};
  const Float3 up{std::sin(roll_rad), 0.3f, std::cos(roll_rad)};
  return render::stereo_pair(render::look_at(eye, looked, up, 0.394f, 0.2561f));
}

std::vector<render::View> any_head(Random& random) {
  const auto within = [&](double low, double high) {
    return static_cast<float>(random.uniform(low, high));
  };
  const float angle_rad = within(-1.2, 1.2);  // about the patient's long axis
  const float nod = within(-0.7, 0.7);        // towards head or feet
  const float roll = within(-0.35, 0.35);
  const Float3 looked{within(-0.02, 0.02), 0.045f, within(-0.12, 0.02)};
  const Float3 away{std::sin(angle_rad) * std::cos(nod), std::cos(angle_rad) * std::cos(nod),
                    std::sin(nod)};
  const Float3 eye = looked + within(0.35, 0.70) * away;
  const Float3 up{std::sin(roll), 0.1f, std::cos(roll)};
  return render::stereo_pair(render::look_at(eye, looked, up, 0.394f, 0.2561f));
}

std::vector<std::string> faults(const OperatingField& field,
                                const std::vector<render::View>& views) {
  std::vector<std::string> found;
  const render::Head head = render::head_of(views);
  for (const render::View& view : views) {
    std::vector<Ink> inks;
    for (const render::TextItem& item : field.scene.texts) {
      if (const auto ink = ink_of(item, head, view)) {
        inks.push_back(*ink);
      }
    }
    find_faults(field, inks, view, found);
  }
  return found;
}

std::vector<Standing> standing(const render::Scene& scene) {
  std::vector<Standing> all;
  for (const render::TextItem& text : scene.texts) {
    all.push_back({text.align, text.offset_right, text.offset_up, !text.runs.empty()});
  }
  return all;
}

}  // namespace orthonav::test
