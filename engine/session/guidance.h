#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/tracked.h"
#include "engine/session/operation_state.h"
#include "engine/session/placed_wire.h"
#include "engine/session/text/status_line.h"
#include "nav/guidance/drill_watch.h"
#include "nav/guidance/screw.h"
#include "nav/guidance/screw_numbers.h"
#include "nav/guidance/shown_clearance.h"
#include "nav/registration/digitizer.h"
#include "nav/tracking/tool.h"
#include "nav/tracking/tool_tracker.h"

namespace orthonav::engine {

/// How well a tool is seen right now, and where its white paper makes a bad background.
struct ToolSight {
  std::string name;
  nav::ToolRole role = nav::ToolRole::kPointer;
  PoseStatus status = PoseStatus::kLost;
  /// Corners of the white paper of each of its tags, as tracked; none while it is lost.
  std::vector<std::array<Point<World>, 4>> papers;
};

/// The tool relative to the selected screw.
struct ToolGuidance {
  /// From this stereo pair, for the displayed numbers, so that head motion since then does not
  /// affect them. Absent if the tool was not measured in this pair: a prediction is no reading.
  std::optional<nav::ScrewGuidance> measured;
  /// Predicted to the display time, for drawing over the patient.
  nav::ScrewGuidance shown;
  Timestamp pose_time{};  ///< mid-exposure of the newest pair in which the tool was measured
  /// Clearance of the planned screw if it were driven along the tool's axis as measured in this
  /// pair. Also absent if the plan states no radius, the tool is not near the plan, or its axis
  /// misses the bone.
  std::optional<nav::ScrewClearance> clearance = {};
  /// Tip and aim in the surgeon's directions, as displayed. Absent if `measured` is, and for a plan
  /// whose directions have no such names (`nav::directions_of`).
  std::optional<nav::ScrewNumbers> numbers = {};
  /// Angle and offset as displayed; absent if `measured` is.
  std::optional<nav::ScrewSizes> sizes = {};
  /// Depth of the tip as displayed; absent if `measured` is, or a metre away.
  std::optional<nav::ShownDepth> depth = {};
  /// `clearance` as displayed; absent if it is.
  std::optional<nav::ShownClearance> shown_clearance = {};
};

/// A region that was just deleted.
struct DroppedRegion {
  nav::Region region;
  Timestamp dropped_at{};
};

/// What is shown if the surgeon asks for it, until they ask again.
struct OnRequest {
  bool twin = false;     ///< the virtual twin
  bool numbers = false;  ///< every number of the guide, or of the rod
};

/// Everything that the surgeon may be shown after one stereo pair, as facts;
/// engine/holograms/scene_builder.h decides what becomes visible. The spans look into the session:
/// valid until its next step.
struct Guidance {
  Timestamp frame_time{};    ///< mid-exposure of the pair
  Timestamp display_time{};  ///< of the frame made from this
  Timestamp pose_time{};     ///< of the pair in which the step's tool was last measured
  Step step = Step::kSetup;
  StatusLine status;
  std::span<const LevelState> levels;
  std::size_t level = 0;  ///< being operated, an index into `levels`
  std::size_t screw = 0;  ///< selected, an index into the level's screws (while guiding)
  std::span<const nav::Region> regions;
  const DroppedRegion* dropped = nullptr;
  /// Guidance on a pose older than this at the display time is hidden.
  Duration stale_after{};
  Duration fade{};     ///< how long a deleted path fades
  bool blank = false;  ///< no more pairs will come, so nothing that could go stale may be shown
  std::optional<ToolGuidance> tool;  ///< absent: not guiding, or no fresh pose to guide on
  /// While guiding, whether or not the tool is seen: a stop stays while the tool is hidden.
  nav::DrillView drill;
  /// In `measure`, the wire as it was measured; null before that.
  const PlacedWire* wire = nullptr;
  std::span<const RodState> rods;
  bool rods_moved_away = false;
  std::span<const ToolSight> tools;
  /// The patient reference that World is attached to; null if World is the headset's map itself.
  const nav::Anchor* anchor = nullptr;
  /// The head's pose in the newest pair with a known one; some holograms face it.
  std::optional<Transform<World, Rig>> head;
  OnRequest asked;  ///< while guiding, and at the rod
  /// The tip was set at the entry of the selected screw, or drilled there.
  bool was_set = false;
  /// Distances of the saved samples from the registered surface, region by region; empty without a
  /// registration to verify.
  std::span<const float> residuals_m;
  /// One per vertex of the level's model: 1 if the bone could have been stroked there but was not,
  /// 0 if it was or can't be; empty without a registration to verify.
  std::span<const float> unstroked;
  /// Places of the current level still to be touched to verify it.
  std::span<const Point<World>> to_check;
};

}  // namespace orthonav::engine
