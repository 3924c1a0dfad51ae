#include "engine/holograms/scene_builder.h"

#include <algorithm>
#include <utility>

#include "base/translation.h"
#include "engine/holograms/anchored_frame.h"
#include "engine/holograms/shapes/hologram_colours.h"
#include "engine/holograms/shapes/hologram_label.h"
#include "engine/holograms/shapes/hologram_numbers.h"
#include "engine/holograms/shapes/hologram_parts.h"
#include "engine/holograms/shapes/render_values.h"
#include "engine/holograms/shapes/screw_holograms.h"
#include "engine/session/tools_in_hand.h"
#include "nav/published/stroke_pattern.h"
#include "render/decimated.h"
#include "render/shapes.h"

namespace orthonav::engine {
namespace {

constexpr render::Label kCross = label_of(HologramKind::kCross, 1);  // its dots: the next
constexpr render::Label kTwin = label_of(HologramKind::kTwin, 1);
constexpr render::Label kTwinTool = label_of(HologramKind::kTwin, 2);
constexpr render::Label kNumbers = label_of(HologramKind::kNumbers, 1);
constexpr render::Label kNextAct = label_of(HologramKind::kNumbers, 2);
constexpr render::Label kClearance = label_of(HologramKind::kNumbers, 3);
constexpr render::Label kWord = label_of(HologramKind::kNumbers, 4);
constexpr render::Label kStop = label_of(HologramKind::kNumbers, 5);  // stays when a pose is old
constexpr CrossLabels kCrossLabels = {label_of(HologramKind::kAngle, 1),
                                      label_of(HologramKind::kNumbers, 6),
                                      label_of(HologramKind::kDepth, 1)};
constexpr render::Label kAngle = label_of(HologramKind::kAngle, 2);  // beside the triangle
constexpr render::Label kTipDistance = label_of(HologramKind::kDepth, 2);

/// The level whose screw of that side has its entry nearest to the head.
std::string_view level_at(const Guidance& guidance, Side side, Point<World> head) {
  std::string_view name;
  double nearest_m = 0.0;
  for (const LevelState& level : guidance.levels) {
    if (!level.usable()) {
      continue;
    }
    for (const nav::ScrewPlan& screw : level.plan.screws) {
      const Point<World> entry = level.registration->world_from_vertebra * screw.entry;
      const double away_m = (entry - head).norm();
      if (screw.side == side && (name.empty() || away_m < nearest_m)) {
        name = level.plan.label;
        nearest_m = away_m;
      }
    }
  }
  return name;
}

}  // namespace

bool depends_on_tool(render::Label label) {
  const HologramKind kind = kind_of(label);
  return kind == HologramKind::kTriangle || kind == HologramKind::kAngle ||
         kind == HologramKind::kDepth || (kind == HologramKind::kNumbers && label != kStop) ||
         label == kCross + 1 || label == kTwinTool;
}

void hide_tool_guidance(render::Scene& scene) {
  const WearersLanguage language;
  // The number's place stays, with dashes.
  const auto of_tool = [](const auto& item) {
    return depends_on_tool(item.label) && kind_of(item.label) != HologramKind::kAngle;
  };
  scene.triangles.erase_if(of_tool);
  scene.lines.erase_if(of_tool);
  scene.texts.erase_if(of_tool);
  take_dots_off(scene, kCross);
  for (render::TextItem& text : scene.texts) {
    if (kind_of(text.label) == HologramKind::kAngle) {
      take_angle_off(text);
    }
  }
}

void write_notice_alone(const render::Scene& scene, std::string_view why, render::Scene& left) {
  const WearersLanguage language;
  left.clear();
  for (const render::TextItem& text : scene.texts) {
    if (text.place == render::TextPlace::kView && text.label != kNextAct) {
      left.texts.push_back(text);
    }
  }
  add_notice(left, translated(why), label_of(HologramKind::kStatus, 2));
  left.texts.back().position = left.texts.front().position;  // where the status line made way
}

void SceneBuilder::update(const Guidance& guidance, Timestamp display_time) {
  decide_visibility(guidance, rules_, display_time, visible_);
  hang_cross(guidance, display_time);
}

/// Hangs H7 beside the place that the eyes rest on.
void SceneBuilder::hang_cross(const Guidance& guidance, Timestamp display_time) {
  if (!visible_.cross || !visible_.trajectory) {
    return;
  }
  const PlacedScrew& screw = *visible_.trajectory;
  if (const std::pair of(screw.at.level, screw.screw); hung_for_ != of) {
    hung_for_ = of;
    gaze_anchor_.reset();
  }
  std::optional<Gaze> gaze = gaze_;
  if (gaze && guidance.anchor) {
    const auto anchored_from_world = guidance.anchor->world_from_anchored.inverse();
    gaze->origin = anchored_from_world * gaze->origin;
    gaze->direction = anchored_from_world * gaze->direction;
  }
  VisibleCross& cross = *visible_.cross;
  cross.aside = gaze_anchor_.follow({site_of(screw.at), screw.at.world_from_vertebra,
                                     cross.world_from_head, cross.side, visible_.entries_of},
                                    gaze, display_time);
}

void SceneBuilder::write_shown(const Guidance& guidance, ShownFrame& frame) {
  shown_.write(guidance, visible_, frame);
  if (guidance.anchor) {
    take_to_map(guidance.anchor->world_from_anchored, frame);
  }
}

void SceneBuilder::write_scene(const Guidance& guidance, render::Scene& scene) {
  const WearersLanguage language;
  scene.clear();
  add_paths(guidance, scene);
  if (visible_.stroke_pattern) {
    add_stroke_pattern(guidance, scene);
  }
  if (visible_.vertebra) {
    add_bone(*visible_.vertebra, guidance.unstroked, scene);
    add_check_points(*visible_.vertebra, guidance.to_check, scene);
  }
  add_entries(scene);
  if (visible_.stroke_next) {
    add_place_to_stroke(scene, to_float3(visible_.stroke_next->v),
                        label_of(HologramKind::kCheckPoint, 1));
  }
  if (visible_.landmark) {
    add_place_to_check(scene, to_float3(visible_.landmark->v),
                       label_of(HologramKind::kCheckPoint, 1));
  }
  if (visible_.trajectory) {
    add_screw(*visible_.trajectory, scene);
  }
  if (visible_.rods) {
    add_rods(guidance, scene);
  }
  add_status(guidance, scene);
  if (guidance.anchor) {
    take_to_map(guidance.anchor->world_from_anchored, scene);
  }
}

void SceneBuilder::add_paths(const Guidance& guidance, render::Scene& scene) {
  const bool checks = visible_.vertebra && (!guidance.to_check.empty() ||
                                            !visible_.vertebra->level->check_points.empty());
  std::size_t measured = 0;  // samples of saved regions so far
  const auto add = [&](const nav::Region& region, std::size_t k, float opacity) {
    points_.clear();
    for (const nav::Sample& sample : region.samples) {
      points_.push_back(to_float3(sample.tip_in_world.v));
    }
    const std::size_t first = measured;
    if (region.saved) {
      measured += points_.size();
    }
    if (points_.size() < 2) {
      return;
    }
    if (region.saved && measured <= guidance.residuals_m.size()) {
      return add_residual_path(scene, points_, guidance.residuals_m.subspan(first, points_.size()),
                               label_of(HologramKind::kPath, k), checks ? kPathBehindChecks : 1.0f);
    }
    add_sampled_path(scene, points_, region.saved ? PathState::kSaved : PathState::kRecording,
                     label_of(HologramKind::kPath, k), opacity);
  };
  if (visible_.paths) {
    // Older ones are dimmer, so that the newest stands out.
    constexpr float kFade = 0.15f;
    constexpr float kLeast = 0.4f;
    for (std::size_t k = 0; k < guidance.regions.size(); ++k) {
      const auto age = static_cast<float>(guidance.regions.size() - 1 - k);
      add(guidance.regions[k], k + 1, std::max(kLeast, 1.0f - kFade * age));
    }
  }
  if (visible_.paths && guidance.dropped) {
    // A deleted region fades, so that the surgeon sees which one it was.
    const double age_s = seconds(guidance.display_time - guidance.dropped->dropped_at);
    const double left = 1.0 - age_s / seconds(guidance.fade);
    if (left > 0.0) {
      add(guidance.dropped->region, kMaxInstances, static_cast<float>(std::min(left, 1.0)));
    }
  }
}

/// The bone from behind, smaller than it is, on the left of the view, with the strokes over it.
void SceneBuilder::add_stroke_pattern(const Guidance& guidance, render::Scene& scene) {
  constexpr Vec3 kIn_view_m{-0.035, 0.0, -0.50};
  constexpr double kScale = 0.6;
  constexpr float kWidth_m = 0.0012F;
  constexpr render::Label kLabel = label_of(HologramKind::kPath, kMaxInstances - 1);
  const LevelState& level = guidance.levels[guidance.level];
  const nav::VertebraModel& model = *level.plan.model;
  const auto [found, made] = patterns_.try_emplace(&model);
  if (made) {
    found->second = nav::published::stroke_pattern(model.reachable(), model.reachable_surface());
  }
  // Seen from behind: the patient's left on the left, superior up, posterior towards the eyes.
  const Mat3 view_from_vertebra = Mat3::from_columns({-1, 0, 0}, {0, 0, 1}, {0, 1, 0});
  const Transform<World, Rig>& head = *guidance.head;
  const Mat3 rotation = head.rotation() * view_from_vertebra;
  const Vec3 middle_m = bounds_of(model.reachable()).centre();
  const Vec3 shift = (head * Point<Rig>{kIn_view_m}).v - kScale * (rotation * middle_m);
  std::array<double, 16> placed = Transform<World, Vertebra>(rotation, shift).row_major();
  for (const std::size_t i : {0U, 1U, 2U, 4U, 5U, 6U, 8U, 9U, 10U}) {
    placed[i] *= kScale;
  }
  add_vertebra(scene, surface_of(level), to_matrix(placed), kLabel);
  for (const std::vector<Vec3>& line : found->second) {
    points_.clear();
    for (const Vec3 place : line) {
      points_.push_back(to_float3(kScale * (rotation * place) + shift));
    }
    add_line(scene, points_, kWidth_m, look::kWhite, kLabel);
  }
}

void SceneBuilder::add_bone(const PlacedLevel& at, std::span<const float> unstroked,
                            render::Scene& scene) {
  add_vertebra(scene, tinted_surface_of(*at.level, unstroked),
               to_matrix(at.world_from_vertebra.row_major()), label_of(HologramKind::kVertebra, 1));
}

void SceneBuilder::add_check_points(const PlacedLevel& at, std::span<const Point<World>> to_check,
                                    render::Scene& scene) {
  std::size_t k = 0;
  if (!to_check.empty()) {
    add_place_to_check(scene, to_float3(to_check.front().v),
                       label_of(HologramKind::kCheckPoint, ++k));
  }
  const std::vector<nav::CheckPoint>& touched = at.level->check_points;
  for (const nav::CheckPoint& point : touched) {
    const render::Label label = label_of(HologramKind::kCheckPoint, ++k);
    const render::Float3 place = to_float3(point.place.v);
    if (&point != &touched.back()) {
      add_earlier_check_point(scene, place, point.within, label);
    } else {
      add_check_point(scene, place, distance_text(point.distance_m), point.within, label);
    }
  }
}

void SceneBuilder::add_entries(render::Scene& scene) {
  std::size_t k = 0;
  for (const PlacedLevel& at : visible_.entries_of) {
    const LevelState& level = *at.level;
    const auto& world_from_vertebra = at.world_from_vertebra;
    for (std::size_t s = 0; s < level.plan.screws.size(); ++s) {
      const nav::ScrewPlan& screw = level.plan.screws[s];
      const auto on_bone = level.plan.model->surface().nearest(screw.entry.v);
      const Vec3 outward = on_bone ? on_bone->normal : (screw.entry - screw.target);
      EntryHologram entry;
      entry.position = to_float3((world_from_vertebra * screw.entry).v);
      entry.surface_normal =
          to_float3((world_from_vertebra * Direction<Vertebra>{outward.normalized()}).v);
      text_.clear();
      append_entry_name(text_, visible_, at, s);
      entry.text = text_;
      entry.done = level.screws[s].done;
      // From behind, where the surgeon looks from, the patient's left is on the left.
      entry.side = screw.side == nav::Side::kLeft ? LabelSide::kLeft : LabelSide::kRight;
      add_entry(scene, entry, label_of(HologramKind::kEntry, ++k));
    }
  }
}

void SceneBuilder::add_screw(const PlacedScrew& screw, render::Scene& scene) {
  const TrajectoryLine line = trajectory_of(screw);
  add_planned_trajectory(scene, to_float3(line.entry.v), to_float3(line.target.v),
                         label_of(HologramKind::kTrajectory, 1));
  if (visible_.wire) {
    add_wire(scene, screw, *visible_.wire, text_);
  }
  if (visible_.triangle) {
    const nav::ScrewGuidance& shown = *visible_.triangle;
    add_deviation_triangle(scene, to_float3(shown.a.v), to_float3(shown.b.v), to_float3(shown.c.v),
                           visible_.verdict.grade, label_of(HologramKind::kTriangle, 1));
  }
  if (!visible_.cross) {
    add_angle(line, scene);
  }
  if (visible_.approach) {
    add_tip_distance(scene, to_float3(visible_.approach->tip.v), visible_.approach->distance_m,
                     kTipDistance);
  }
  if (visible_.cross) {
    add_cross(screw, scene);
  }
  if (visible_.twin) {
    add_virtual_twin(screw, scene);
  }
}

/// H6 beside the triangle; without one, where it would be if the tool were on the plan.
void SceneBuilder::add_angle(const TrajectoryLine& line, render::Scene& scene) {
  if (visible_.measurement) {
    const nav::ScrewGuidance& shown = *visible_.triangle;
    add_angle_readout(scene, to_float3(shown.a.v), to_float3(shown.b.v),
                      angle_text(visible_.measurement->angle_rad), visible_.verdict.grade, kAngle);
  } else if (visible_.angle_lost) {
    add_angle_readout(scene, to_float3(line.entry.v), to_float3(line.outside.v),
                      angle_text(std::nullopt), Grade::kPoor, kAngle);
  }
}

/// The triangle is where the tool will be at the display time; the numbers, and the verdict behind
/// every colour, come from one stereo pair.
void SceneBuilder::add_cross(const PlacedScrew& screw, render::Scene& scene) {
  const TargetCross cross = cross_of(screw, visible_);
  add_target_cross(scene, cross, kCross);
  if (visible_.sizes != nullptr || visible_.angle_lost) {
    add_cross_numbers(scene, cross, cross_numbers_of(visible_), kCrossLabels);
  }
  text_.clear();
  append_cross_word(text_, visible_);
  if (!text_.empty()) {
    const bool stop = visible_.drill.alarm == nav::DrillAlarm::kStop;
    const bool breaks = visible_.verdict.grade == Grade::kPoor || stop || !visible_.drill.watched;
    add_cross_word(scene, cross, text_, breaks ? look::colours().poor : look::colours().fair, stop,
                   stop ? kStop : kWord);
  }
  if (visible_.numbers) {
    add_numbers(scene, cross, *visible_.numbers, screw.at.level->registration_only(), kNumbers,
                visible_.clearance && visible_.clearance->lower_95_tenths);
    if (visible_.clearance) {
      add_clearance(scene, cross, *visible_.clearance, kClearance);
    }
  }
}

void SceneBuilder::add_virtual_twin(const PlacedScrew& screw, render::Scene& scene) {
  const VirtualTwin twin = twin_of(screw);
  const TrajectoryLine line = trajectory_of(screw);
  parts_.clear();
  add_vertebra(parts_, surface_of(*screw.at.level),
               to_matrix(screw.at.world_from_vertebra.row_major()), kTwin);
  add_planned_trajectory(parts_, to_float3(line.entry.v), to_float3(line.target.v), kTwin);
  add_twin(scene, twin, parts_, kTwin);
  if (!visible_.triangle) {
    return;
  }
  const nav::ScrewGuidance& shown = *visible_.triangle;
  parts_.clear();
  add_deviation_triangle(parts_, to_float3(shown.a.v), to_float3(shown.b.v), to_float3(shown.c.v),
                         visible_.verdict.grade, kTwinTool);
  add_tool(parts_, to_float3(shown.tip.v), to_float3(shown.tool_outward), kTwinTool);
  add_twin(scene, twin, parts_, kTwinTool);
}

void SceneBuilder::add_rods(const Guidance& guidance, render::Scene& scene) {
  tubes_.resize(guidance.rods.size());
  for (std::size_t i = 0; i < guidance.rods.size(); ++i) {
    const RodState& rod = guidance.rods[i];
    if (!rod.visible()) {
      continue;
    }
    RodHologram hologram;
    hologram.tube = tube_of(i, rod);
    points_.clear();
    for (const Point<World>& head : rod.heads) {
      points_.push_back(to_float3(head.v));
    }
    hologram.heads = points_;
    bends_.clear();
    if (rod.rod) {
      for (const nav::RodBend& bend : rod.rod->bends) {
        bends_.push_back({to_float3(bend.position_m), bend.angle_rad, bend.arc_length_m});
      }
      hologram.length_m = rod.rod->length_m;
    }
    if (rod.instructions) {  // how it is made, in place of its shape
      bends_.clear();
      for (const nav::RodInstruction& bend : rod.instructions->bends) {
        bends_.push_back({to_float3(bend.middle_m), bend.arc.angle_rad, bend.arc.centre_m,
                          RodBendMark::Making{bend.arc.roll_rad, bend.set_rad}});
      }
      hologram.length_m = rod.instructions->cut_length_m();
      hologram.to_cut = true;
    }
    names_.clear();
    for (const Point<World>& head : rod.heads) {
      names_.push_back(level_at(guidance, rod.side, head));
    }
    hologram.head_names = names_;
    hologram.bends = bends_;
    hologram.first_bend_only = !guidance.numbers;
    hologram.offset = to_float3(rod_offset_m(guidance, rod));
    add_rod(scene, hologram, label_of(HologramKind::kRod, i + 1));
  }
}

void SceneBuilder::add_status(const Guidance& guidance, render::Scene& scene) {
  dots_.clear();
  for (const ToolSight& tool : guidance.tools) {
    // A red dot for a tool that nobody needs now would be a false alarm.
    if (guidance.step != Step::kSetup && !used_in(tool.role, guidance.step)) {
      continue;
    }
    const ToolState state = tool.status == PoseStatus::kMeasured    ? ToolState::kMeasured
                            : tool.status == PoseStatus::kPredicted ? ToolState::kPredicted
                                                                    : ToolState::kLost;
    dots_.push_back({state});
  }
  text_.clear();
  append_step(text_, guidance.status.at);
  detail_.clear();
  parts_of_detail_.clear();
  append_detail(detail_, guidance.status, &parts_of_detail_);
  const bool acts = detail_.empty();
  detail_.clear();
  parts_of_detail_.clear();
  append_beside_step(detail_, guidance.status, &parts_of_detail_);
  add_status_line(scene, StatusWords{text_, detail_, &parts_of_detail_}, dots_,
                  label_of(HologramKind::kStatus, 1));
  if (acts) {
    text_.clear();
    append_next_act(text_, guidance, visible_);
    add_next_act(scene, text_, detail_.empty() ? 1 : 2, kNextAct);
  }
  if (visible_.drill.alarm == nav::DrillAlarm::kStop) {
    text_.clear();
    append_drill(text_, visible_.drill);
    add_stop_row(scene, text_, kStop);
  }
}

// The meshes that a scene shares from frame to frame.

void SceneBuilder::prepare(std::span<const LevelState> levels) {
  for (const LevelState& level : levels) {
    surface_of(level);
  }
}

const std::shared_ptr<const render::MeshData>& SceneBuilder::surface_of(const LevelState& level) {
  auto& surface = surfaces_[level.plan.model.get()];
  if (!surface) {
    surface = mesh_data(level.plan.model->mesh());
  }
  return surface;
}

const std::shared_ptr<const render::MeshData>& SceneBuilder::tinted_surface_of(
    const LevelState& level, std::span<const float> tints) {
  const auto& surface = surface_of(level);
  if (tints.size() != surface->positions.size()) {
    return surface;
  }
  const bool known = tinted_from_ == surface.get() &&
                     std::equal(tints.begin(), tints.end(), tinted_->tints.begin());
  if (!known) {
    auto tinted = std::make_shared<render::MeshData>(*surface);
    tinted->tints.assign(tints.begin(), tints.end());
    tinted_ = std::move(tinted);
    tinted_from_ = surface.get();
  }
  return tinted_;
}

const std::shared_ptr<const render::MeshData>& SceneBuilder::tube_of(std::size_t i,
                                                                     const RodState& rod) {
  Tube& tube = tubes_[i];
  if (tube.points == rod.heads) {
    return tube.mesh;
  }
  tube.points = rod.heads;
  tube.mesh.reset();
  if (rod.rod) {
    std::vector<render::Float3> path;
    for (const Vec3 p : rod.rod->path_m) {
      path.push_back(to_float3(p));
    }
    tube.mesh =
        render::prepared(render::make_tube(path, static_cast<float>(rod.rod->diameter_m / 2.0)));
  }
  return tube.mesh;
}

}  // namespace orthonav::engine
