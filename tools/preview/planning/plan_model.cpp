#include "tools/preview/planning/plan_model.h"

#include <algorithm>
#include <cmath>

namespace orthonav::preview {
namespace {

/// A handle is hit within this fraction of the pane's height.
constexpr double kHandle = 0.035;
constexpr double kScroll_m = 0.001;
constexpr double kDeepest_m = 0.120;
constexpr double kMaxMagnification = 6.0;
constexpr double kZoomStep = 1.1;
/// Without a screw: the slices through the middle of the bone, from this far behind it.
constexpr double kBehind_m = 0.020;
constexpr double kNoScrew_m = 0.040;

/// The stage of the camera: front up, seen from below; origin in the middle of the bone.
Transform<sim::Room, Vertebra> stage_from(Point<Vertebra> middle) {
  const Mat3 turn = Mat3::from_columns({1, 0, 0}, {0, -1, 0}, {0, 0, -1});
  return {turn, -(turn * middle.v)};
}

Point<Vertebra> middle_of(const engine::PlanEditor& editor) {
  return {nav::bounds_of(editor.level().mesh).centre()};
}

}  // namespace

const char* name_of(Pane pane) {
  constexpr std::array<const char*, kPanes> kNames = {"axial", "sagittal", "across", "space"};
  return kNames[static_cast<std::size_t>(pane)];
}

PanePlace pane_place(Vec2 at, double aspect) {
  const bool right = at.x > 0.5 * aspect;
  const bool low = at.y > 0.5;
  const auto number = static_cast<std::size_t>(right ? 1 : 0) + (low ? 2 : 0);
  const Vec2 middle{(right ? 0.75 : 0.25) * aspect, low ? 0.75 : 0.25};
  return {static_cast<Pane>(number), {2.0 * (at.x - middle.x), -2.0 * (at.y - middle.y)}};
}

PlanModel::PlanModel(engine::PlanEditor& editor) : editor_(editor) {
  reset_views();
  look_anew();
}

void PlanModel::reset_views() {
  depth_m_.reset();
  magnification_ = 1.0;
  camera_ = {};
  // From below, and a little from behind.
  camera_.start_orbit({Mat3::identity(), {0.0, 0.0, 0.45}});
  camera_.orbit({0.0, -0.2});
  window_ = engine::kBoneWindow;
}

/// Lays the slices through the screw as it is now.
void PlanModel::look_anew() {
  changed_ = true;
  if (editor_.held()) {
    return;
  }
  nav::Axis<Vertebra> axis{middle_of(editor_) + Vec3{0.0, kBehind_m, 0.0}, {0.0, -1.0, 0.0}};
  double length_m = kNoScrew_m;
  across_m_ = 0.5 * length_m;
  if (const nav::ScrewPlan* screw = editor_.screw()) {
    axis = {screw->entry, (screw->target - screw->entry).normalized()};
    length_m = (screw->target - screw->entry).norm();
    across_m_ = editor_.clearance() ? editor_.clearance()->arc_length_m : 0.5 * length_m;
  }
  across_m_ = depth_m_.value_or(across_m_);
  slices_ = engine::slices_of(axis, length_m, across_m_);
  for (engine::SlicePlane* plane : {&slices_.axial, &slices_.sagittal, &slices_.across}) {
    plane->half_m /= magnification_;
  }
}

const engine::SlicePlane& PlanModel::slice(Pane pane) const {
  return pane == Pane::kAxial      ? slices_.axial
         : pane == Pane::kSagittal ? slices_.sagittal
                                   : slices_.across;
}

Transform<Vertebra, Eye> PlanModel::vertebra_from_eye() const {
  return stage_from(middle_of(editor_)).inverse() * camera_.stage_from_eye();
}

void PlanModel::tell(const Status& status) {
  note_ = status ? std::string() : status.error().message;
  asked_to_discard_ = false;
  look_anew();
}

void PlanModel::say(std::string_view phrase) {
  if (!phrase.empty()) {
    tell(editor_.say(phrase));
  }
}

void PlanModel::select(const engine::ScrewPlace& place) {
  editor_.select(place);
  depth_m_.reset();
  tell({});
}

void PlanModel::key(Key key, bool down) {
  const PlanKeyBinding* binding = plan_binding_of(key);
  if (!binding || !down) {
    return;
  }
  switch (binding->command) {
    case PlanCommand::kSay:
      return say(binding->what);
    case PlanCommand::kNext:
    case PlanCommand::kBefore:
      editor_.select_beside(binding->command == PlanCommand::kNext);
      return select(editor_.place());
    case PlanCommand::kSave:
      wishes_.save = true;
      return;
    case PlanCommand::kViews:
      reset_views();
      return look_anew();
    case PlanCommand::kScreenshot:
      wishes_.screenshot = true;
      return;
    case PlanCommand::kPanel:
      panel_ = !panel_;
      return;
    case PlanCommand::kHelp:
      help_ = !help_;
      return;
    case PlanCommand::kQuit:
      wishes_.quit = true;
      return;
    case PlanCommand::kDiscard:
      return discard();
  }
}

void PlanModel::discard() {
  if (editor_.unsaved() && !std::exchange(asked_to_discard_, true)) {
    note_ = "not saved: once more quits without saving";
    return;
  }
  wishes_.quit = wishes_.discard = true;
}

/// By fractions of a pane's height, to the right and down.
void PlanModel::change_window(Vec2 by) {
  constexpr double kPerHeight_hu = 2000.0;
  constexpr double kNarrowest_hu = 50.0;
  constexpr double kWidest_hu = 6000.0;
  constexpr double kFarthest_hu = 3000.0;
  const double width_hu = std::clamp(window_.white_hu - window_.black_hu + kPerHeight_hu * by.x,
                                     kNarrowest_hu, kWidest_hu);
  // Upward is brighter: what is grey lies lower.
  const double level_hu =
      std::clamp(0.5 * (window_.white_hu + window_.black_hu) + kPerHeight_hu * by.y, -kFarthest_hu,
                 kFarthest_hu);
  window_ = {level_hu - 0.5 * width_hu, level_hu + 0.5 * width_hu};
  changed_ = true;
}

/// The part of the screw there; none beside it.
std::optional<nav::ScrewPart> PlanModel::part_at(const PanePlace& place) const {
  const nav::ScrewPlan* screw = editor_.screw();
  if (!screw) {
    return std::nullopt;
  }
  const engine::SlicePlane& plane = slice(place.pane);
  const double reach_m = 2.0 * plane.half_m * kHandle;
  const Vec2 at = 2.0 * plane.half_m * place.at;
  const Vec2 entry = plane.in_plane(screw->entry);
  const Vec2 target = plane.in_plane(screw->target);
  const double beside_m = std::max(reach_m, screw->radius_m);
  if (place.pane == Pane::kAcross) {
    const Vec3 inward = (screw->target - screw->entry).normalized();
    const Vec2 middle = plane.in_plane(screw->entry + across_m_ * inward);
    return (at - middle).norm() < beside_m ? std::optional(nav::ScrewPart::kWhole) : std::nullopt;
  }
  if ((at - target).norm() < reach_m) {
    return nav::ScrewPart::kTarget;
  }
  if ((at - entry).norm() < reach_m) {
    return nav::ScrewPart::kEntry;
  }
  const Vec2 way = target - entry;
  const double along = (at - entry).dot(way) / std::max(way.dot(way), 1e-12);
  const Vec2 nearest = entry + std::clamp(along, 0.0, 1.0) * way;
  return (at - nearest).norm() < beside_m ? std::optional(nav::ScrewPart::kWhole) : std::nullopt;
}

void PlanModel::press() {
  const PanePlace place = pane_place(cursor_, aspect_);
  held_in_ = place.pane;
  if (place.pane == Pane::kSpace) {
    return;
  }
  held_at_m_ = drawn_to_m_ = 2.0 * slice(place.pane).half_m * place.at;
  if (const auto part = part_at(place)) {
    editor_.grab(*part);
  }
}

/// Moves what is held to a place in its slice. False: no screw can lie there.
bool PlanModel::drag_to(Vec2 in_plane_m) {
  const engine::SlicePlane& plane = slice(*held_in_);
  const Vec2 by = in_plane_m - held_at_m_;
  const bool moved = editor_.drag(by.x * plane.right + by.y * plane.up);
  note_ = moved ? "" : "no screw can lie there";
  changed_ = true;
  return moved;
}

void PlanModel::move(Vec2 at) {
  const Vec2 by = at - std::exchange(cursor_, at);
  if (!held_in_) {
    return;
  }
  if (*held_in_ == Pane::kSpace) {
    camera_.orbit(2.0 * by);
    changed_ = true;
  } else if (editor_.held()) {
    const engine::SlicePlane& plane = slice(*held_in_);
    // The held pane counts, even when the mouse has left it.
    drawn_to_m_ = drawn_to_m_ + 4.0 * plane.half_m * Vec2{by.x, -by.y};
    drag_to(drawn_to_m_);
  } else if (over_scan_) {
    change_window(2.0 * by);
  }
}

void PlanModel::release() {
  held_in_.reset();
  if (editor_.held()) {
    editor_.drop();
    look_anew();
  }
}

void PlanModel::scroll(double steps) {
  const Pane pane = pane_place(cursor_, aspect_).pane;
  if (pane == Pane::kSpace) {
    camera_.zoom(steps);
  } else if (pane == Pane::kAcross) {
    depth_m_ = std::clamp(across_m_ - steps * kScroll_m, 0.0, kDeepest_m);
  } else {
    magnification_ = std::clamp(magnification_ * std::pow(kZoomStep, steps),
                                1.0 / kMaxMagnification, kMaxMagnification);
  }
  look_anew();
}

bool PlanModel::drag(Pane pane, nav::ScrewPart part, Vec2 by_m) {
  if (pane == Pane::kSpace || !editor_.grab(part)) {
    return false;
  }
  held_in_ = pane;
  held_at_m_ = {};
  const bool moved = drag_to(by_m);
  release();
  return moved;
}

}  // namespace orthonav::preview
