#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/holograms/shapes/hologram_shapes.h"
#include "engine/session/guidance.h"

namespace orthonav::engine {

/// How long guidance stays valid is decided by the session and stated in the guidance.
struct VisibilityRules {
  GradeLimits grades;
  /// H7 and H9, and the numbers beside them (H13), which the publication does not have.
  bool cross_and_depth = true;
  /// In `digitize`, a picture of the pattern in which the published method's surgeon strokes.
  bool stroke_pattern = false;
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

/// The one verdict on a tool at the screw: the worst of angle, offset, depth, clearance and
/// certainty. It decides every colour and shape, and which element is drawn bright.
struct ToolVerdict {
  Grade grade = Grade::kPoor;
  Worst worst = Worst::kNothing;
};

/// A tool on its way to the screw.
struct VisibleApproach {
  Point<World> tip;         ///< predicted to the display time
  double distance_m = 0.0;  ///< from the entry, as measured in this pair
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
  const LevelState* level = nullptr;             ///< in work, named by the status line; or null
  bool paths = false;                            ///< H1
  bool stroke_pattern = false;                   ///< the picture of where to stroke
  std::optional<PlacedLevel> vertebra;           ///< H2 and H12, of the current level
  std::vector<PlacedLevel> entries_of;           ///< H3: the levels whose entry points are shown
  bool entry_labels = false;                     ///< their names too, until a screw is in
  bool only_selected_named = false;              ///< of those, the selected screw's alone
  std::optional<Point<World>> stroke_next;       ///< H12: the middle of what to stroke next
  std::optional<Point<World>> landmark;          ///< H12: the landmark, while it is to be touched
  std::optional<PlacedScrew> trajectory;         ///< H4 of the selected screw
  const PlacedWire* wire = nullptr;              ///< the measured wire beside H4, or null
  const nav::ScrewGuidance* triangle = nullptr;  ///< H5, predicted to the display time; or null
  const nav::ScrewGuidance* measurement = nullptr;  ///< of the pair behind every number; or null
  ToolVerdict verdict;                              ///< on the triangle's tool
  const nav::ScrewSizes* sizes = nullptr;           ///< angle and offset, of `measurement`; or null
  const nav::ShownDepth* depth = nullptr;           ///< H9, likewise; or null
  const nav::ShownClearance* clearance = nullptr;   ///< likewise; or null
  const nav::ScrewNumbers* numbers = nullptr;       ///< H13, likewise, if asked for; or null
  std::optional<VisibleApproach> approach;          ///< in place of the cross
  nav::DrillView drill;                             ///< shown with the cross
  bool angle_lost = false;                          ///< H6 without a number
  std::optional<VisibleCross> cross;                ///< H7
  LabelSide cross_side = LabelSide::kLeft;          ///< the side on which the cross was last
  bool twin = false;                                ///< H8 of the selected screw
  bool rods = false;                                ///< H10
  /// Time of the pair on which H5 and the dots of H7 are based; absent if neither is shown.
  std::optional<Timestamp> pose_time;
};

/// Decides for a frame shown at `display_time`, which may be later than the guidance expected.
void decide_visibility(const Guidance& guidance, const VisibilityRules& rules,
                       Timestamp display_time, Visibility& out);

}  // namespace orthonav::engine
