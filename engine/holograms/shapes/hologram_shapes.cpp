#include "engine/holograms/shapes/hologram_shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <utility>

#include "base/angle.h"
#include "base/length_text.h"
#include "base/printed.h"
#include "base/translation.h"
#include "engine/holograms/shapes/hologram_parts.h"
#include "engine/session/text/wording.h"
#include "render/float3.h"
#include "render/shapes.h"

namespace orthonav::engine {
namespace {

using render::Colour;
using render::Float3;
using render::Label;
using render::Scene;

constexpr float kPathWidth_m = 0.001f;
constexpr float kNear_m = 0.001f;
constexpr float kFar_m = 0.002f;
constexpr float kEntryRadius_m = 0.0015f;
constexpr float kEntryRingRadius_m = 0.003f;
constexpr float kEntryRingWidth_m = 0.0006f;
constexpr float kTrajectoryWidth_m = 0.002f;
constexpr float kPlacedWireWidth_m = 0.0015f;
constexpr float kDash_m = 0.004f;
constexpr float kTriangleEdge_m = 0.001f;
constexpr float kTriangleFill = 0.30f;
constexpr float kReadoutOutward_m = 0.006f;
constexpr float kHeadRadius_m = 0.0042f;  // a little wider than the rod, so that it shows around it
constexpr float kBendRingRadius_m = 0.0042f;
constexpr float kBendRingWidth_m = 0.0010f;

/// Hyphens as wide as digits and a leading blank of one digit's width, so that the number keeps
/// its place while it changes.
std::string fixed_width(std::string_view text) {
  std::string out;
  const std::size_t point = text.find('.');
  if (point == 1) {
    out += "\u2007";
  }
  for (const char c : text) {
    c == '-' ? out += "\u2012" : out += c;
  }
  return out;
}

void add_bend_text(Scene& scene, const RodBendMark& bend, Float3 at, Label label) {
  render::TextItem& text = add_text_beside(scene, at, 1.6f, 0.0035f, 0.35f, label);
  if (bend.making) {
    append_printed(add_run(text, look::kWhite), translated("%.0f mm, roll %.0f°, set %.1f°"),
                   bend.arc_length_m * 1e3, degrees(bend.making->roll_rad),
                   degrees(bend.making->set_rad));
    return;
  }
  add_run(text, angle_text(bend.angle_rad), look::kWhite);
  add_run(text, look::kSoftWhite).append(" ").append(translated(words::kAt)).append(" ");
  add_run(text, in_mm(bend.arc_length_m), look::kSoftWhite);
}

/// In degrees; absent if there is no angle.
std::optional<std::array<char, 16>> angle_digits(std::optional<double> angle_rad) {
  const double angle_deg = angle_rad ? *angle_rad * kDegreesPerRadian : std::nan("");
  if (!(angle_deg >= 0.0 && angle_deg < 99.95)) {
    return std::nullopt;
  }
  // Adding 0 turns a negative zero into a positive one.
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), "%.1f", angle_deg + 0.0);
  return text;
}

}  // namespace

std::vector<std::string> GradeLimits::check() const {
  std::vector<std::string> problems;
  if (!(good_rad > 0.0 && good_rad <= std::numbers::pi)) {
    problems.push_back("good_rad must lie in (0, pi]");
  }
  if (!(poor_rad >= good_rad && poor_rad <= std::numbers::pi)) {
    problems.push_back("poor_rad must lie in [good_rad, pi]");
  }
  if (!(good_offset_m > 0.0 && good_offset_m <= 1.0)) {
    problems.push_back("good_offset_m must lie in (0, 1]");
  }
  if (!(poor_offset_m >= good_offset_m && poor_offset_m <= 1.0)) {
    problems.push_back("poor_offset_m must lie in [good_offset_m, 1]");
  }
  return problems;
}

Grade grade_of(double angle_rad, const GradeLimits& limits) {
  if (!(angle_rad <= limits.poor_rad)) {
    return Grade::kPoor;
  }
  return angle_rad < limits.good_rad ? Grade::kGood : Grade::kFair;
}

Grade grade_of_offset(double offset_m, const GradeLimits& limits) {
  if (!(offset_m <= limits.poor_offset_m)) {
    return Grade::kPoor;
  }
  return offset_m < limits.good_offset_m ? Grade::kGood : Grade::kFair;
}

Colour colour_of(Grade grade) {
  switch (grade) {
    case Grade::kGood:
      return look::colours().good;
    case Grade::kFair:
      return look::colours().fair;
    case Grade::kPoor:
      break;
  }
  return look::colours().poor;
}

std::string angle_text(std::optional<double> angle_rad) {
  const auto digits = angle_digits(angle_rad);
  return digits ? std::string(digits->data()) + "°" : "--.-°";
}

std::optional<double> read_angle_rad(std::optional<double> angle_rad) {
  const auto digits = angle_digits(angle_rad);
  return digits ? std::optional(std::strtod(digits->data(), nullptr) * kRadiansPerDegree)
                : std::nullopt;
}

void add_sampled_path(Scene& scene, std::span<const Float3> samples, PathState state, Label label,
                      float opacity) {
  if (samples.empty() || !(opacity > 0)) {
    return;
  }
  const Colour colour =
      state == PathState::kRecording ? look::colours().recording : look::colours().saved;
  add_line(scene, samples, kPathWidth_m, faded(colour, std::fmin(opacity, 1.0f)), label);
}

void add_residual_path(Scene& scene, std::span<const Float3> samples,
                       std::span<const float> distances_m, Label label, float opacity) {
  const auto band = [&](std::size_t i) {
    const float away = std::abs(distances_m[i]);
    return away <= kNear_m ? Grade::kGood : (away <= kFar_m ? Grade::kFair : Grade::kPoor);
  };
  const std::size_t count = std::min(samples.size(), distances_m.size());
  for (std::size_t first = 0; first + 1 < count;) {
    std::size_t last = first + 1;
    while (last + 1 < count && band(last) == band(first)) {
      ++last;
    }
    add_line(scene, samples.subspan(first, last - first + 1), kPathWidth_m,
             faded(colour_of(band(first)), opacity), label);
    first = last;
  }
}

void add_vertebra(Scene& scene, std::shared_ptr<const render::MeshData> mesh,
                  const render::Matrix4& world_from_model, Label label) {
  add_mesh(scene, std::move(mesh), world_from_model, look::colours().bone, label);
  scene.meshes.back().tint = look::colours().unstroked;
  scene.meshes.back().style = render::MeshStyle::kRim;
}

void add_entry(Scene& scene, const EntryHologram& entry, Label label) {
  add_sphere(scene, entry.position, kEntryRadius_m, look::colours().entry, label);
  add_ring(scene, entry.position, entry.surface_normal, kEntryRingRadius_m, kEntryRingWidth_m,
           look::colours().entry, label);
  if (entry.text.empty() && !entry.done) {
    return;
  }
  const float beside = entry.side == LabelSide::kRight ? 1.2f : -1.2f;
  render::TextItem& text = add_text_beside(scene, entry.position, beside, 0.0045f, 0.5f, label);
  add_run(text, entry.text, look::kWhite);
  if (entry.done) {
    add_run(text, " ✓", look::kWhite);
  }
}

Float3 trajectory_outer_end(Float3 entry, Float3 target) {
  return entry + kTrajectoryOutside_m * render::unit_or(entry - target, {0, 1, 0});
}

void add_planned_trajectory(Scene& scene, Float3 entry, Float3 target, Label label) {
  add_line(scene, {trajectory_outer_end(entry, target), entry}, kTrajectoryWidth_m,
           look::colours().good, label);
  // A gap first: the dashes must not add up with the solid part at the entry.
  const Float3 inward = render::unit_or(target - entry, {0, -1, 0});
  if (render::length(target - entry) <= kDash_m) {
    return;
  }
  add_line(scene, {entry + kDash_m * inward, target}, kTrajectoryWidth_m, look::colours().good,
           label, kDash_m);
}

void add_placed_wire(Scene& scene, Float3 outside, Float3 deep, std::string_view text, bool within,
                     Label label) {
  add_line(scene, {outside, deep}, kPlacedWireWidth_m,
           within ? look::colours().placed : look::colours().poor, label);
  render::TextItem& item = add_text_beside(scene, outside, 2.5f, 0.0045f, 0.55f, label);
  if (!within) {
    item.rim = look::colours().poor;
  }
  add_run(item, text, look::kWhite);
  add_run(item, within ? " ✓" : " ✗", look::kWhite);
}

void add_deviation_triangle(Scene& scene, Float3 a, Float3 b, Float3 c, Grade grade, Label label) {
  const Colour colour = colour_of(grade);
  scene.triangles.push_back({label, {a, b, c}, faded(colour, kTriangleFill)});
  add_line(scene, {a, b, c}, kTriangleEdge_m, colour, label, grade == Grade::kPoor ? kDash_m : 0.0f,
           true);
}

void add_angle_readout(Scene& scene, Float3 a, Float3 b, std::string_view text, Grade grade,
                       Label label) {
  render::TextItem& item = scene.texts.emplace_back();
  item.label = label;
  item.position = b + kReadoutOutward_m * render::unit_or(b - a, {0, 1, 0});
  item.align = render::TextAlign::kLeft;
  item.offset_right = 0.9f;  // clear of B even when the eye looks down the tool's axis
  item.height_m = 0.007f;
  item.min_height_deg = 0.8f;
  item.rim = colour_of(grade);
  add_run(item, fixed_width(text), look::kWhite);
}

void take_angle_off(render::TextItem& angle) {
  angle.rim = colour_of(Grade::kPoor);
  angle.runs.clear();
  add_run(angle, fixed_width(angle_text(std::nullopt)), look::kWhite);
}

void add_rod(Scene& scene, const RodHologram& rod, Label label) {
  if (rod.tube && !rod.tube->indices.empty()) {
    add_mesh(scene, rod.tube, render::placed_at(rod.offset), look::colours().rod, label);
  }
  for (const Float3 head : rod.heads) {
    add_sphere(scene, head + rod.offset, kHeadRadius_m, look::colours().entry, label);
  }
  const Float3 along = rod.heads.empty()
                           ? Float3{0, 1, 0}
                           : render::unit_or(rod.heads.back() - rod.heads.front(), {0, 1, 0});
  for (std::size_t i = 0; i < rod.head_names.size(); ++i) {
    add_run(add_text_beside(scene, rod.heads[i] + rod.offset, 1.8f, 0.0040f, 0.4f, label),
            rod.head_names[i], look::kWhite);
  }
  for (std::size_t i = 0; i < rod.bends.size(); ++i) {
    const Float3 at = rod.bends[i].position + rod.offset;
    add_ring(scene, at, along, kBendRingRadius_m, kBendRingWidth_m, look::colours().fair, label);
    if (i == 0 || !rod.first_bend_only) {
      add_bend_text(scene, rod.bends[i], at, label);
    }
  }
  if (rod.heads.size() < 2 || !rod.length_m) {
    return;
  }
  render::TextItem& text = scene.texts.emplace_back();
  text.label = label;
  text.position = rod.heads.back() + 0.012f * along + rod.offset;
  text.height_m = 0.005f;
  text.min_height_deg = 0.6f;
  if (rod.to_cut) {
    append_printed(add_run(text, look::kWhite), translated("cut to %s"),
                   format_mm(*rod.length_m).c_str());
  } else {
    add_run(text, in_mm(*rod.length_m), look::kWhite);
  }
}

}  // namespace orthonav::engine
