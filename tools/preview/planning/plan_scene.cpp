#include "tools/preview/planning/plan_scene.h"

#include <cmath>

#include "base/printed.h"
#include "engine/case/screw_breach.h"
#include "engine/holograms/shapes/hologram_colours.h"
#include "engine/holograms/shapes/render_values.h"
#include "nav/planning/pedicle_screws.h"
#include "render/projection.h"
#include "render/shapes.h"

namespace orthonav::preview {
namespace {

using engine::SlicePlane;
using engine::to_float3;

/// So far away that everything near the slice is drawn as if by parallel rays.
constexpr double kFar_m = 1.0;
constexpr render::Colour kOutline{0.95f, 0.75f, 0.35f, 1};
constexpr render::Colour kText{0.9f, 0.9f, 0.9f, 1};
constexpr render::Colour kRim{0, 0, 0, 1};
constexpr render::Colour kOtherScrew{0.35f, 0.38f, 0.42f, 1};
/// Of the pane's height.
constexpr double kTextHeight = 0.026;
constexpr double kMargin = 0.035;
constexpr double kHandleRadius = 0.016;
/// What lies this near to a slice is drawn in it.
constexpr double kInSlice_m = 0.004;
constexpr double kBesideBone_m = 0.006;
constexpr double kScale_m = 0.010;
/// The axis is drawn beyond the entry by this part of the screw.
constexpr double kBeyond = 0.12;
constexpr double kTanInSpace = 0.105;

/// Draws in a slice; places in metres from its middle.
class SliceDrawing {
 public:
  SliceDrawing(const SlicePlane& plane, render::Scene& scene) : plane_(plane), scene_(scene) {}

  void line(std::initializer_list<Vec2> points, const render::Colour& colour, double dash_m = 0.0,
            bool closed = false) {
    render::LineItem& item = scene_.lines.emplace_back();
    for (const Vec2 point : points) {
      item.points.push_back(to_float3(plane_.at(point).v));
    }
    item.colour = colour;
    item.width_m = 0.0f;  // the thinnest
    item.dash_m = static_cast<float>(dash_m);
    item.closed = closed;
  }
  void ring(Vec2 middle, double radius_m, const render::Colour& colour) {
    render::LineItem& item = scene_.lines.emplace_back();
    render::set_ring(item.points, to_float3(plane_.at(middle).v), to_float3(plane_.toward()),
                     static_cast<float>(radius_m), 32);
    item.colour = colour;
    item.width_m = 0.0f;
    item.closed = true;
  }
  void text(const std::string& text, Vec2 at, render::TextAlign align,
            const render::Colour& colour = kText) {
    render::TextItem& item = scene_.texts.emplace_back();
    render::TextRun& run = item.runs.emplace_back();
    run.text = text;
    run.colour = colour;
    item.position = to_float3(plane_.at(at).v);
    item.align = align;
    item.height_m = static_cast<float>(2.0 * plane_.half_m * kTextHeight);
    item.rim = kRim;
  }
  [[nodiscard]] const SlicePlane& plane() const { return plane_; }
  /// Of the slice's height.
  [[nodiscard]] double part_m(double part) const { return 2.0 * plane_.half_m * part; }

 private:
  const SlicePlane& plane_;
  render::Scene& scene_;
};

/// Letters at the borders: which way is the patient's left, right, front, back, head, feet.
struct BorderLetters {
  const char* left;
  const char* right;
  const char* up;
  const char* down;
};
constexpr std::array<BorderLetters, 3> kLetters = {
    {{"R", "L", "A", "P"}, {"A", "P", "H", "F"}, {"R", "L", "H", "F"}}};

std::string title_of(const PlanModel& model, Pane pane) {
  switch (pane) {
    case Pane::kAxial:
      return "axial, along the screw";
    case Pane::kSagittal:
      return "sagittal, along the screw";
    case Pane::kAcross:
      return model.editor().screw() == nullptr
                 ? "coronal"
                 : printed("across, %.0f mm past the entry", 1e3 * model.across_m());
    case Pane::kSpace:
      break;
  }
  return {};
}

void add_frame(const PlanModel& model, Pane pane, double aspect, SliceDrawing& drawing) {
  using enum render::TextAlign;
  const double half_m = drawing.plane().half_m;
  const double edge_m = drawing.part_m(kMargin);
  const double side_m = aspect * half_m - edge_m;
  const double text_m = drawing.part_m(kTextHeight);
  const BorderLetters& letters = kLetters[static_cast<std::size_t>(pane)];
  drawing.text(letters.left, {-side_m, 0.0}, kCentre);
  drawing.text(letters.right, {side_m, 0.0}, kCentre);
  drawing.text(letters.up, {0.0, half_m - edge_m - text_m}, kCentre);
  drawing.text(letters.down, {0.0, edge_m - half_m}, kCentre);
  drawing.text(title_of(model, pane), {-side_m, half_m - edge_m - text_m}, kLeft);
  const Vec2 scale{side_m, edge_m - half_m};
  drawing.line({scale - Vec2{kScale_m, 0.0}, scale}, kText);
  drawing.text("10 mm", scale + Vec2{0.0, 0.4 * text_m}, kRight);
  if (model.over_scan()) {
    const engine::GreyWindow& window = model.window();
    drawing.text(printed("W %.0f L %.0f", window.white_hu - window.black_hu,
                         0.5 * (window.white_hu + window.black_hu)),
                 {-side_m, edge_m - half_m}, kLeft);
  }
}

/// A screw as its outline in the plane of its axis.
void add_lengthwise(const nav::ScrewPlan& screw, const render::Colour& colour,
                    SliceDrawing& drawing) {
  const Vec2 entry = drawing.plane().in_plane(screw.entry);
  const Vec2 target = drawing.plane().in_plane(screw.target);
  const Vec2 way = target - entry;
  const Vec2 side = (screw.radius_m / std::max(way.norm(), 1e-9)) * Vec2{-way.y, way.x};
  drawing.line({entry + side, target + side, target - side, entry - side}, colour, 0.0, true);
  drawing.line({entry - kBeyond * way, target}, colour, 0.002);
}

/// Where its axis crosses the slice, as a circle; nothing beyond its ends.
void add_crosswise(const nav::ScrewPlan& screw, const render::Colour& colour,
                   SliceDrawing& drawing) {
  const Vec3 way = screw.target - screw.entry;
  const double across = way.dot(drawing.plane().toward());
  const double part = (drawing.plane().centre - screw.entry).dot(drawing.plane().toward()) / across;
  if (!(part >= 0.0 && part <= 1.0)) {
    return;
  }
  const Vec2 middle = drawing.plane().in_plane(screw.entry + part * way);
  drawing.ring(middle, screw.radius_m, colour);
  const Vec2 arm{0.001, 0.0}, up{0.0, 0.001};
  drawing.line({middle - arm, middle + arm}, colour);
  drawing.line({middle - up, middle + up}, colour);
}

bool lies_in(const SlicePlane& plane, const nav::ScrewPlan& screw) {
  const Vec3 toward = plane.toward();
  return std::abs((screw.entry - plane.centre).dot(toward)) < kInSlice_m &&
         std::abs((screw.target - plane.centre).dot(toward)) < kInSlice_m;
}

void add_screws(const PlanModel& model, Pane pane, SliceDrawing& drawing) {
  const engine::PlanEditor& editor = model.editor();
  const auto add = pane == Pane::kAcross ? add_crosswise : add_lengthwise;
  const nav::ScrewPlan* other = editor.other_screw();
  if (other && (pane == Pane::kAcross || lies_in(drawing.plane(), *other))) {
    add(*other, kOtherScrew, drawing);
  }
  const nav::ScrewPlan* screw = editor.screw();
  if (!screw) {
    return;
  }
  const render::Colour colour = colour_of(editor.clearance());
  add(*screw, colour, drawing);
  if (pane != Pane::kAcross) {
    const double radius_m = drawing.part_m(kHandleRadius);
    drawing.ring(drawing.plane().in_plane(screw->entry), radius_m, engine::look::colours().entry);
    drawing.ring(drawing.plane().in_plane(screw->target), radius_m, kText);
  }
}

/// From the screw to the nearest wall, where that lies in the slice.
void add_clearance(const PlanModel& model, SliceDrawing& drawing) {
  const auto& least = model.editor().clearance();
  if (!least) {
    return;
  }
  const SlicePlane& plane = drawing.plane();
  const double before_m = (least->place - plane.centre).dot(plane.toward());
  if (std::abs(before_m) > kInSlice_m || std::abs(least->outward.dot(plane.toward())) > 0.7) {
    return;
  }
  const Vec2 from = plane.in_plane(least->place);
  const Vec2 to = plane.in_plane(least->place + least->clearance_m * least->outward);
  const render::Colour colour = colour_of(least);
  drawing.line({from, to}, kText);
  const bool right = plane.in_plane({plane.centre.v + least->outward}).x >= 0.0;
  const double gap_m = drawing.part_m(0.015);
  drawing.text(
      engine::clearance_text(least->clearance_m),
      (right ? std::max(from.x, to.x) + gap_m : std::min(from.x, to.x) - gap_m) * Vec2{1.0, 0.0} +
          Vec2{0.0, 0.5 * (from.y + to.y)},
      right ? render::TextAlign::kLeft : render::TextAlign::kRight, colour);
}

void add_screw_in_space(const nav::ScrewPlan& screw, const render::Colour& colour,
                        render::Scene& scene) {
  const Vec3 inward = (screw.target - screw.entry).normalized();
  render::MeshItem& body = scene.meshes.emplace_back();
  body.mesh = std::make_shared<render::MeshData>(
      render::make_cylinder(to_float3(screw.entry.v), to_float3(screw.target.v),
                            static_cast<float>(std::max(screw.radius_m, 0.0005))));
  body.colour = colour;
  render::LineItem& axis = scene.lines.emplace_back();
  axis.points = {to_float3(screw.entry.v - 0.03 * inward), to_float3(screw.entry.v)};
  axis.colour = colour;
}

/// "L" or "R" beside the bone.
void add_side(const nav::Bounds& bone, bool left, render::Scene& scene) {
  Vec3 beside = bone.centre();
  beside.x = left ? bone.high.x + kBesideBone_m : bone.low.x - kBesideBone_m;
  render::TextItem& item = scene.texts.emplace_back();
  render::TextRun& run = item.runs.emplace_back();
  run.text = left ? "L" : "R";
  run.colour = kText;
  item.position = to_float3(beside);
  item.height_m = 0.0025f;
}

}  // namespace

render::Colour colour_of(const std::optional<nav::Clearance>& clearance) {
  if (!clearance) {
    return kText;
  }
  const engine::HologramColours& colours = engine::look::colours();
  const double wanted_m = nav::PlanningRules{}.wanted_clearance_m;
  return clearance->clearance_m < 0.0        ? colours.poor
         : clearance->clearance_m < wanted_m ? colours.fair
                                             : colours.good;
}

void add_slice(const PlanModel& model, Pane pane, double aspect, render::Scene& scene) {
  SliceDrawing drawing(model.slice(pane), scene);
  for (const auto& [from, to] : engine::outline_in(drawing.plane(), model.editor().level().mesh)) {
    drawing.line({from, to}, kOutline);
  }
  add_screws(model, pane, drawing);
  add_clearance(model, drawing);
  add_frame(model, pane, aspect, drawing);
}

render::View view_of(const SlicePlane& plane, double aspect) {
  const Point<Vertebra> eye = plane.centre + kFar_m * plane.toward();
  const double tan_up = plane.half_m / kFar_m;
  const auto tan_across = static_cast<float>(aspect * tan_up);
  return render::look_at(to_float3(eye.v), to_float3(plane.centre.v), to_float3(plane.up),
                         tan_across, static_cast<float>(tan_up));
}

void add_space(const PlanModel& model, const DrawnBone& bone, render::Scene& scene) {
  const engine::PlanEditor& editor = model.editor();
  if (const nav::ScrewPlan* other = editor.other_screw()) {
    add_screw_in_space(*other, kOtherScrew, scene);
  }
  if (const nav::ScrewPlan* screw = editor.screw()) {
    add_screw_in_space(*screw, colour_of(editor.clearance()), scene);
  }
  render::MeshItem& surface = scene.meshes.emplace_back();
  surface.mesh = bone.mesh;
  surface.colour = engine::look::colours().bone;
  surface.style = render::MeshStyle::kRim;
  const nav::Bounds bounds = nav::bounds_of(editor.level().mesh);
  add_side(bounds, true, scene);
  add_side(bounds, false, scene);
}

render::View view_in_space(const PlanModel& model, double aspect) {
  render::View view;
  view.eye_from_world = engine::to_matrix(model.vertebra_from_eye().inverse().row_major());
  view.tan_up = view.tan_down = static_cast<float>(kTanInSpace);
  view.tan_left = view.tan_right = static_cast<float>(aspect * kTanInSpace);
  return view;
}

}  // namespace orthonav::preview
