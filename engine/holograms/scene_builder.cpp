#include "engine/holograms/scene_builder.h"

#include <utility>

#include "base/translation.h"
#include "engine/holograms/anchored_frame.h"
#include "engine/holograms/shapes/hologram_status.h"
#include "engine/holograms/shapes/render_values.h"
#include "engine/holograms/shapes/screw_holograms.h"

namespace orthonav::engine {

ShownHologram& ShownHolograms::add(HologramKind kind) {
  if (used_ == frame_.holograms.size()) {
    frame_.holograms.emplace_back();
  }
  ShownHologram& hologram = frame_.holograms[used_++];
  hologram.kind = kind;
  hologram.level.clear();
  hologram.side.reset();
  hologram.text.clear();
  hologram.reading.reset();
  hologram.points_in_world.clear();
  return hologram;
}

const std::shared_ptr<const render::MeshData>& Surfaces::of(const LevelState& level) {
  auto& surface = made_[level.plan.model.get()];
  if (!surface) {
    surface = mesh_data(level.plan.model->mesh());
  }
  return surface;
}

bool depends_on_tool(render::Label label) {
  const HologramKind kind = kind_of(label);
  return kind == HologramKind::kTriangle || kind == HologramKind::kAngle ||
         kind == HologramKind::kDepth ||
         (kind == HologramKind::kNumbers && label != labels::kStop) ||
         label == labels::kCross + 1 || label == labels::kTwinTool;
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
  take_dots_off(scene, labels::kCross);
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
    if (text.place == render::TextPlace::kView && text.label != labels::kNextAct) {
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
  const WearersLanguage language;
  frame.display_time = guidance.display_time;
  frame.pose_time = guidance.pose_time;
  ShownHolograms told(frame);
  for (const auto& hologram : holograms_) {
    hologram->tell(guidance, visible_, told);
  }
  told.end();
  if (guidance.anchor) {
    take_to_map(guidance.anchor->world_from_anchored, frame);
  }
}

void SceneBuilder::write_scene(const Guidance& guidance, render::Scene& scene) {
  const WearersLanguage language;
  scene.clear();
  for (const auto& hologram : holograms_) {
    hologram->draw(guidance, visible_, scene);
  }
  if (guidance.anchor) {
    take_to_map(guidance.anchor->world_from_anchored, scene);
  }
}

SceneBuilder::SceneBuilder(const VisibilityRules& rules) : rules_(rules) {
  holograms_.push_back(strokes_hologram(surfaces_));
  holograms_.push_back(bone_hologram(surfaces_));
  holograms_.push_back(entries_hologram());
  holograms_.push_back(next_place_hologram());
  holograms_.push_back(selected_screw_hologram(surfaces_));
  holograms_.push_back(rods_hologram());
  holograms_.push_back(status_hologram());
}

void SceneBuilder::prepare(std::span<const LevelState> levels) {
  for (const LevelState& level : levels) {
    surfaces_.of(level);
  }
}

}  // namespace orthonav::engine
