#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/holograms/hologram_shapes.h"
#include "engine/session/guidance.h"

namespace orthonav::engine {

/// How long guidance stays valid is decided by the session and stated in the guidance.
struct VisibilityRules {
  double triangle_within_m = 0.040;  ///< of the tip from the entry
  double rod_moved_away_m = 0.150;
  GradeLimits grades;
  /// H7 and H9, and the numbers beside them (H13), which the publication does not have.
  bool cross_and_depth = true;
  /// In `digitize`, a picture of the pattern in which the published method's surgeon strokes.
  bool stroke_pattern = false;

  /// Every problem at once; empty when all is well.
  [[nodiscard]] std::vector<std::string> check() const;
};

/// A registered level, whose vertebra has a pose in the world.
struct PlacedLevel {
  const LevelState* level = nullptr;  ///< never null
  Transform<World, Vertebra> world_from_vertebra;
};

/// One of its screws.
struct PlacedScrew {
  PlacedLevel at;
  std::size_t screw = 0;  ///< an index into the plan's
  [[nodiscard]] const nav::ScrewPlan& plan() const { return at.level->plan.screws[screw]; }
};

/// H7 of the selected screw.
struct VisibleCross {
  Transform<World, Rig> world_from_head;
  LabelSide side = LabelSide::kLeft;         ///< of the site
  const nav::ScrewGuidance* dots = nullptr;  ///< where the tool was measured; null: no dots
  bool lost = false;                         ///< it says that the tool is lost
  /// From the site to the place that it hangs beside; absent: it hangs beside the site.
  std::optional<Direction<Vertebra>> aside;
};

/// Which holograms a frame shows, each with the data it needs. Computed once, so that the drawn
/// scene and the frame in words can't differ. Points into the guidance that it was made from, and
/// is valid only as long as that guidance is.
struct Visibility {
  bool paths = false;                               ///< H1
  bool stroke_pattern = false;                      ///< the picture of where to stroke
  std::optional<PlacedLevel> vertebra;              ///< H2 and H12, of the current level
  std::vector<PlacedLevel> entries_of;              ///< H3: the levels whose entry points are shown
  bool entry_labels = false;                        ///< their names too
  std::optional<PlacedScrew> trajectory;            ///< H4 of the selected screw
  const PlacedWire* wire = nullptr;                 ///< the measured wire beside H4, or null
  const nav::ScrewGuidance* triangle = nullptr;     ///< H5, predicted to the display time; or null
  const nav::ScrewGuidance* measurement = nullptr;  ///< the number of H6; or null
  /// H13 and its row of the status line, from the pair of `measurement`; or null.
  const nav::ScrewNumbers* numbers = nullptr;
  const nav::ShownDepth* depth = nullptr;          ///< H9, likewise; or null
  const nav::ShownClearance* clearance = nullptr;  ///< under the numbers; or null
  nav::DrillView drill;                            ///< shown with the cross
  bool angle_lost = false;                         ///< H6 without a number
  std::optional<VisibleCross> cross;               ///< H7
  LabelSide cross_side = LabelSide::kLeft;         ///< the side on which the cross was last
  bool twin = false;                               ///< H8 of the selected screw
  bool rods = false;                               ///< H10
  const LyingRod* lying_rod = nullptr;             ///< H10 of the rod in hand; or null
  /// Time of the pair on which H5 and the dots of H7 are based; absent if neither is shown.
  std::optional<Timestamp> pose_time;
};

/// Decides for a frame shown at `display_time`, which may be later than the guidance expected.
void decide_visibility(const Guidance& guidance, const VisibilityRules& rules,
                       Timestamp display_time, Visibility& out);

/// From where to where the rods are shifted while they are moved away: sideways off the patient,
/// as a rigid body, each to its own side.
[[nodiscard]] Vec3 rod_offset_m(const Guidance& guidance, const RodState& rod,
                                const VisibilityRules& rules);

}  // namespace orthonav::engine
