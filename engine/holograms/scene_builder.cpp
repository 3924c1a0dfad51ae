#include "engine/holograms/scene_builder.h"

#include <algorithm>

#include "base/translation.h"
#include "engine/holograms/anchored_frame.h"
#include "engine/holograms/hologram_colours.h"
#include "engine/holograms/hologram_label.h"
#include "engine/holograms/hologram_numbers.h"
#include "engine/holograms/hologram_parts.h"
#include "engine/holograms/render_values.h"
#include "engine/holograms/screw_holograms.h"
#include "nav/published/stroke_pattern.h"

namespace orthonav::engine {
namespace {

constexpr render::Label kCross = label_of(HologramKind::kCross, 1);  // its dots: the next
constexpr render::Label kTwin = label_of(HologramKind::kTwin, 1);
constexpr render::Label kTwinTool = label_of(HologramKind::kTwin, 2);
constexpr render::Label kNumbers = label_of(HologramKind::kNumbers, 1);
constexpr render::Label kClearance = label_of(HologramKind::kNumbers, 3);
constexpr render::Label kDrill = label_of(HologramKind::kNumbers, 4);
constexpr render::Label kStop = label_of(HologramKind::kNumbers, 5);  // stays when a pose is old
constexpr render::Label kNumbersRow = label_of(HologramKind::kNumbers, 2);

}  // namespace

bool hangs_on_tool(render::Label label) {
  const HologramKind kind = kind_of(label);
  return kind == HologramKind::kTriangle || kind == HologramKind::kAngle ||
         kind == HologramKind::kDepth || (kind == HologramKind::kNumbers && label != kStop) ||
         label == kCross + 1 || label == kTwinTool;
}

void hide_tool_guidance(render::Scene& scene) {
  const WearersLanguage language;
  // The number's place stays, with dashes.
  const auto of_tool = [](const auto& item) {
    return hangs_on_tool(item.label) && kind_of(item.label) != HologramKind::kAngle;
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
    if (text.place == render::TextPlace::kView && text.label != kNumbersRow) {
      left.texts.push_back(text);
    }
  }
  add_notice(left, translated(why), label_of(HologramKind::kStatus, 2));
}

void SceneBuilder::update(const Guidance& guidance, Timestamp display_time) {
  decide_visibility(guidance, rules_, display_time, visible_);
  hang_cross(guidance, display_time);
}

void SceneBuilder::write_shown(const Guidance& guidance, ShownFrame& frame) {
  shown_.write(guidance, visible_, rules_, frame);
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
  if (visible_.trajectory) {
    add_screw(*visible_.trajectory, scene);
  }
  if (visible_.rods) {
    add_rods(guidance, scene);
  }
  if (visible_.lying_rod) {
    add_lying_rod(*visible_.lying_rod, scene);
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
    for (std::size_t k = 0; k < guidance.regions.size(); ++k) {
      add(guidance.regions[k], k + 1, 1.0f);
    }
  }
  if (visible_.paths && guidance.dropped) {
    // A deleted region fades, so that the surgeon sees which one it was.
    const double age_s = seconds(guidance.display_time - guidance.dropped->dropped_at);
    const double left = 1.0 - age_s / seconds(guidance.fade);
    if (left > 0.0) {
      add(guidance.dropped->region, kMostInstances, static_cast<float>(std::min(left, 1.0)));
    }
  }
}

/// The bone from behind, smaller than it is, on the left of the view, with the strokes over it.
void SceneBuilder::add_stroke_pattern(const Guidance& guidance, render::Scene& scene) {
  constexpr Vec3 kIn_view_m{-0.035, 0.0, -0.50};
  constexpr double kScale = 0.6;
  constexpr float kWidth_m = 0.0012F;
  constexpr render::Label kLabel = label_of(HologramKind::kPath, kMostInstances - 1);
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
      if (visible_.entry_labels) {
        append_screw(text_, level.plan.label, screw.side);
      }
      entry.text = text_;
      entry.done = level.screw_done[s];
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
    add_tool_guidance(*visible_.triangle, scene);
  }
  if (visible_.cross) {
    const TargetCross cross = cross_of(screw, *visible_.cross, rules_);
    add_target_cross(scene, cross, kCross);
    if (visible_.numbers) {
      add_numbers(scene, cross, *visible_.numbers, screw.at.level->registration_only(), kNumbers,
                  visible_.clearance && visible_.clearance->lower_95_tenths);
    }
    if (visible_.clearance) {
      add_clearance(scene, cross, *visible_.clearance, kClearance);
    }
    add_drill(scene, cross, visible_.drill,
              visible_.drill.alarm == nav::DrillAlarm::kStop ? kStop : kDrill);
  }
  if (visible_.twin) {
    add_virtual_twin(screw, scene);
  }
  if (visible_.angle_lost && !visible_.triangle) {
    // The place of the number if the tool were on the plan.
    add_angle_readout(scene, to_float3(line.entry.v), to_float3(line.outside.v),
                      angle_text(std::nullopt), Grade::kPoor, label_of(HologramKind::kAngle, 1));
  }
}

/// The overlay is where the tool will be at the display time; the numbers and their colour come
/// from one stereo pair. A predicted pose has no number and is never shown as good.
void SceneBuilder::add_tool_guidance(const nav::ScrewGuidance& shown, render::Scene& scene) {
  const nav::ScrewGuidance* measured = visible_.measurement;
  const Grade grade = grade_of_tool(visible_, rules_);
  const render::Float3 a = to_float3(shown.a.v);
  const render::Float3 b = to_float3(shown.b.v);
  add_deviation_triangle(scene, a, b, to_float3(shown.c.v), grade,
                         label_of(HologramKind::kTriangle, 1));
  add_angle_readout(scene, a, b,
                    angle_text(measured ? std::optional(measured->angle_rad) : std::nullopt), grade,
                    label_of(HologramKind::kAngle, 1));
  if (visible_.depth) {
    add_depth(scene, a, b, *visible_.depth, label_of(HologramKind::kDepth, 1));
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
                         grade_of_tool(visible_, rules_), kTwinTool);
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
    hologram.bends = bends_;
    hologram.offset = to_float3(rod_offset_m(guidance, rod, rules_));
    add_rod(scene, hologram, label_of(HologramKind::kRod, i + 1));
  }
}

void SceneBuilder::add_status(const Guidance& guidance, render::Scene& scene) {
  dots_.clear();
  for (const ToolSight& tool : guidance.tools) {
    const ToolState state = tool.status == PoseStatus::kMeasured    ? ToolState::kMeasured
                            : tool.status == PoseStatus::kPredicted ? ToolState::kPredicted
                                                                    : ToolState::kLost;
    dots_.push_back({tool.name, state});
  }
  text_.clear();
  append_step(text_, guidance.status.at);
  detail_.clear();
  parts_of_detail_.clear();
  append_beside_step(detail_, guidance.status, &parts_of_detail_);
  add_status_line(scene, StatusWords{text_, detail_, &parts_of_detail_}, dots_,
                  label_of(HologramKind::kStatus, 1));
  if (visible_.numbers) {
    text_.clear();
    append_numbers(text_, *visible_.numbers, visible_.trajectory->at.level->registration_only());
    add_row_above_status(scene, text_, kNumbersRow);
  }
  if (visible_.drill.alarm == nav::DrillAlarm::kStop) {
    text_.clear();
    append_drill(text_, visible_.drill);
    add_stop_row(scene, text_, kStop);
  }
}

}  // namespace orthonav::engine
