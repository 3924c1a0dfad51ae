#pragma once

#include <memory>
#include <span>
#include <vector>

#include "engine/holograms/hologram.h"
#include "engine/holograms/labels/gaze_anchor.h"
#include "engine/holograms/visibility.h"
#include "engine/session/guidance.h"
#include "engine/session/shown_frame.h"
#include "engine/session/text/wording.h"
#include "render/scene.h"

namespace orthonav::engine {

/// The only place where guidance becomes visible: as a scene of values for the renderer and as the
/// same frame in words for the display. visibility.cpp decides what is shown, the holograms'
/// sources where, hologram_shapes.cpp how it looks. One thread at a time.
class SceneBuilder {
 public:
  explicit SceneBuilder(const VisibilityRules& rules = {});
  SceneBuilder(const SceneBuilder&) = delete;
  SceneBuilder& operator=(const SceneBuilder&) = delete;

  /// Makes what takes too long for a frame: the levels' surfaces.
  void prepare(std::span<const LevelState> levels);
  /// Where the eyes look, in the headset's map, for the updates that follow; absent: not known.
  void look_at(const std::optional<Gaze>& gaze) { gaze_ = gaze; }
  /// Decides what this guidance shows in a frame shown when it expects, or later; the two
  /// below then show exactly that.
  void update(const Guidance& guidance) { update(guidance, guidance.display_time); }
  void update(const Guidance& guidance, Timestamp display_time);
  void write_shown(const Guidance& guidance, ShownFrame& frame);
  void write_scene(const Guidance& guidance, render::Scene& scene);
  [[nodiscard]] const Visibility& visible() const { return visible_; }

 private:
  void hang_cross(const Guidance& guidance, Timestamp display_time);

  VisibilityRules rules_;
  Visibility visible_;
  std::optional<Gaze> gaze_;
  GazeAnchor gaze_anchor_;
  std::optional<std::pair<const LevelState*, std::size_t>> hung_for_;  ///< the screw of the cross
  Surfaces surfaces_;
  std::vector<std::unique_ptr<Hologram>> holograms_;
};

/// Whether items with this label depend on a tool's pose and become wrong once it is too old.
[[nodiscard]] bool depends_on_tool(render::Label label);

/// Removes the deviation triangle from a scene and the number from its readout, if the pose they
/// depend on became too old before they were drawn.
void hide_tool_guidance(render::Scene& scene);

/// Reduces a scene that is no longer reliable to the status line, which is fixed to the head, with
/// the reason above it.
void write_notice_alone(const render::Scene& scene, std::string_view why, render::Scene& left);
/// The same while the head is not located.
inline void write_head_lost(const render::Scene& scene, render::Scene& left) {
  write_notice_alone(scene, words::kHeadNotLocated, left);
}

}  // namespace orthonav::engine
