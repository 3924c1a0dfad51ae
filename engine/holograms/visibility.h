#pragma once

#include <string>
#include <vector>

#include "engine/holograms/hologram_shapes.h"
#include "engine/session/guidance.h"

namespace orthonav::engine {

/// How long what is shown stays true is the session's to say: it comes with the guidance.
struct VisibilityRules {
  double triangle_within_m = 0.040;  ///< of the tip from the entry
  double rod_moved_away_m = 0.150;
  GradeLimits grades;

  /// Every problem at once; empty when all is well.
  [[nodiscard]] std::vector<std::string> check() const;
};

/// Which holograms one frame shows. Computed once, so that what is drawn and what the display is
/// told can't differ.
struct Visibility {
  bool paths = false;                       ///< H1
  bool vertebra = false;                    ///< H2 of the current level
  std::vector<std::size_t> entries_of;      ///< H3: the levels whose entry points are shown
  bool entry_labels = false;                ///< their names too
  bool trajectory = false;                  ///< H4 of the selected screw
  bool triangle = false;                    ///< H5
  bool angle = false;                       ///< H6 with a number
  bool angle_lost = false;                  ///< H6 without one
  bool cross = false;                       ///< H7 of the selected screw
  LabelSide cross_side = LabelSide::kLeft;  ///< of the site
  bool cross_dots = false;                  ///< where the tool stands on it
  bool cross_lost = false;                  ///< it says that the tool is lost
  bool twin = false;                        ///< H8
  bool depth = false;                       ///< H9
  bool rods = false;                        ///< H10
  bool check_points = false;                ///< H12 of the current level
};

/// For a frame shown at `display_time`, which may be later than the guidance expected.
void decide_visibility(const Guidance& guidance, const VisibilityRules& rules,
                       Timestamp display_time, Visibility& out);

/// From where to where the rods are shifted while they are moved away: sideways off the patient,
/// as a rigid body, each to its own side.
[[nodiscard]] Vec3 rod_shift_m(const Guidance& guidance, const RodState& rod,
                               const VisibilityRules& rules);

}  // namespace orthonav::engine
