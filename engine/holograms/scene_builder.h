#pragma once

#include <map>
#include <memory>
#include <span>
#include <vector>

#include "engine/holograms/labels/gaze_anchor.h"
#include "engine/holograms/shapes/hologram_shapes.h"
#include "engine/holograms/shapes/hologram_status.h"
#include "engine/holograms/shown_frame.h"
#include "engine/holograms/visibility.h"
#include "engine/session/guidance.h"
#include "engine/session/shown_frame.h"
#include "engine/session/text/wording.h"
#include "render/scene.h"

namespace orthonav::engine {

struct TrajectoryLine;

/// The only place where guidance becomes visible: as a scene of values for the renderer and as the
/// same frame in words for the display. visibility.cpp decides what is shown, hologram_shapes.cpp
/// how it looks. One thread at a time.
class SceneBuilder {
 public:
  explicit SceneBuilder(const VisibilityRules& rules = {}) : rules_(rules) {}

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
  struct Tube {
    std::vector<Point<World>> points;  ///< heads or axis, for which the tube was made
    std::shared_ptr<const render::MeshData> mesh;
  };

  void hang_cross(const Guidance& guidance, Timestamp display_time);
  void add_paths(const Guidance& guidance, render::Scene& scene);
  void add_bone(const PlacedLevel& at, std::span<const float> unstroked, render::Scene& scene);
  void add_check_points(const PlacedLevel& at, std::span<const Point<World>> to_check,
                        render::Scene& scene);
  void add_stroke_pattern(const Guidance& guidance, render::Scene& scene);
  void add_entries(render::Scene& scene);
  void add_screw(const PlacedScrew& screw, render::Scene& scene);
  void add_angle(const TrajectoryLine& line, render::Scene& scene);
  void add_cross(const PlacedScrew& screw, render::Scene& scene);
  void add_virtual_twin(const PlacedScrew& screw, render::Scene& scene);
  void add_rods(const Guidance& guidance, render::Scene& scene);
  void add_status(const Guidance& guidance, render::Scene& scene);
  const std::shared_ptr<const render::MeshData>& surface_of(const LevelState& level);
  const std::shared_ptr<const render::MeshData>& tinted_surface_of(const LevelState& level,
                                                                   std::span<const float> tints);
  const std::shared_ptr<const render::MeshData>& tube_of(std::size_t i, const RodState& rod);

  VisibilityRules rules_;
  Visibility visible_;
  std::optional<Gaze> gaze_;
  GazeAnchor gaze_anchor_;
  std::optional<std::pair<const LevelState*, std::size_t>> hung_for_;  ///< the screw of the cross
  ShownFrameWriter shown_;
  // The renderer keeps its copies by pointer: one surface per level, one tube per rod, made once.
  std::map<const nav::VertebraModel*, std::shared_ptr<const render::MeshData>> surfaces_;
  /// The lines of its pattern, in the frame of the model.
  std::map<const nav::VertebraModel*, std::vector<std::vector<Vec3>>> patterns_;
  std::vector<Tube> tubes_;
  std::shared_ptr<const render::MeshData> tinted_;  ///< of the registration shown last
  const render::MeshData* tinted_from_ = nullptr;   ///< the surface that it was made of
  // Reused from frame to frame.
  std::vector<render::Float3> points_;
  std::vector<RodBendMark> bends_;
  std::vector<std::string_view> names_;
  std::string text_;
  std::string detail_;
  StatusParts parts_of_detail_;
  std::vector<ToolDot> dots_;
  render::Scene parts_;  ///< of the twin
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
