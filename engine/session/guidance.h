#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/tracked.h"
#include "engine/case/operation.h"
#include "engine/session/bone_found.h"
#include "engine/session/landmark.h"
#include "engine/session/placed_wire.h"
#include "engine/session/status_line.h"
#include "engine/session/touched_heads.h"
#include "engine/session/workflow.h"
#include "nav/guidance/clearance_spread.h"
#include "nav/guidance/drill_watch.h"
#include "nav/guidance/executed_trajectory.h"
#include "nav/guidance/predicted_error.h"
#include "nav/guidance/rod.h"
#include "nav/guidance/rod_bends.h"
#include "nav/guidance/rod_expectation.h"
#include "nav/guidance/screw.h"
#include "nav/guidance/screw_numbers.h"
#include "nav/guidance/shown_clearance.h"
#include "nav/registration/check_points.h"
#include "nav/registration/digitizer.h"
#include "nav/registration/registration.h"
#include "nav/tracking/anchor.h"
#include "nav/tracking/tool.h"

namespace orthonav::engine {

/// A registration, passed or not, with the points it was computed from.
struct RegistrationAttempt {
  std::vector<Point<World>> points;
  nav::Registration registration;
};

/// A tag whose size differs from its tool's definition: larger by `fraction`.
struct TagSizeWarning {
  std::string tool;
  double fraction = 0.0;
};

/// The outcome of a placed wire.
struct WireOutcome {
  bool asked = false;  ///< a measurement was asked for before the screw was declared done
  std::optional<PlacedWire> measured;
};

/// The state of one level of the operation.
struct LevelState {
  /// Its screws are the plan in use everywhere; only Replanning and a redo change them.
  OperatedLevel plan;
  /// Its screws as they were planned before surgery; never changed.
  std::vector<nav::ScrewPlan> preoperative;
  /// For each screw, the plan in use before each of its changes that was not undone, the newest
  /// last. Once the screw was redone, the first is the plan of the old hole, to which there is no
  /// return.
  std::vector<std::vector<nav::ScrewPlan>> earlier_plans;
  int attempts = 0;  ///< registrations asked for so far
  /// The newest registration that passed its limits; removed when the surgeon rejects it.
  std::optional<nav::Registration> registration;
  /// With a patient reference: where the anchored World lay on the headset's map then; absent after
  /// a restart.
  std::optional<Transform<World, World>> registered_on_map;
  /// The uncertainty that the registration leaves, screw by screw.
  std::vector<nav::PredictedScrewError> predicted;
  /// The places touched to verify that registration, in order.
  std::vector<nav::CheckPoint> check_points;
  std::optional<TagSizeWarning> tag_size;  ///< of the newest registration
  /// The newest registration that found a pose, passed or not, for reports.
  std::optional<RegistrationAttempt> newest;
  /// In the bone's frame, by the registration it was first touched on; removed with it.
  std::optional<Landmark> landmark;
  /// When the bone was last found where that registration puts it; removed with it.
  std::optional<BoneFound> bone_found;
  bool accepted = false;  ///< by the surgeon; required for guidance
  /// Restored from the log and not verified since: nothing is guided on it until its landmark is
  /// found, or check points pass and "accept" is said.
  bool unverified = false;
  std::optional<Timestamp> first_press;  ///< start of the digitization that led to the registration
  double digitization_s = 0.0;           ///< from the first press to the registration
  std::vector<bool> screw_done;
  /// For each screw that is done: of the planned screw along the tool as last measured at depth.
  std::vector<std::optional<nav::ScrewClearance>> clearance_at_depth;
  /// For each screw that is done: where its tool went, as tracked.
  std::vector<std::optional<nav::ExecutedTrajectory>> executed;
  std::vector<WireOutcome> wires;  ///< for each screw that is done
  /// How often each screw was redone; its plan has the newest entry.
  std::vector<int> redone;
  /// Finished, and the map has moved since: kept for the report, shown nowhere.
  bool map_moved = false;

  [[nodiscard]] bool finished() const {
    return std::find(screw_done.begin(), screw_done.end(), false) == screw_done.end();
  }
  [[nodiscard]] bool replanned(std::size_t screw) const {
    return screw < earlier_plans.size() && !earlier_plans[screw].empty();
  }
  [[nodiscard]] bool can_undo(std::size_t screw) const {
    return earlier_plans[screw].size() > (redone[screw] > 0 ? 1U : 0U);
  }
  /// The first screw that is not done; none if all are.
  [[nodiscard]] std::optional<std::size_t> open_screw() const {
    const auto open = std::find(screw_done.begin(), screw_done.end(), false);
    return open == screw_done.end()
               ? std::nullopt
               : std::optional(static_cast<std::size_t>(open - screw_done.begin()));
  }
  /// Discards the registration with everything based on it, except wires already driven.
  void forget_registration() {
    registration.reset();
    registered_on_map.reset();
    predicted.clear();
    check_points.clear();
    landmark.reset();
    bone_found.reset();
    accepted = false;
    unverified = false;
    first_press.reset();
  }
  /// The expected errors leave out the errors common to all strokes, which are unknown.
  [[nodiscard]] bool registration_only() const {
    return registration && !(registration->common.sd_m() > 0.0);
  }
  /// SD along an axis of World's offset from the registration, with its drift since the bone was
  /// found.
  [[nodiscard]] double walked_sd_m(Timestamp now) const {
    return bone_found ? bone_found->sd_at_m(now) : 0.0;
  }
  /// World's vertebra may be shown and guided on.
  [[nodiscard]] bool usable() const {
    return accepted && !unverified && registration && !map_moved;
  }
};

/// One rod: the heads as touched, the template once there are two heads, and how to bend it.
struct RodState {
  nav::Side side = nav::Side::kLeft;
  TouchedHeads touched;
  std::vector<Point<World>> heads;  ///< each the mean of its touches
  std::optional<nav::RodTemplate> rod;
  /// How to bend it, with the bender and the material of the options; absent if there is no
  /// template, or for the reason in `no_instructions`.
  std::optional<nav::RodInstructions> instructions;
  std::string no_instructions;
  /// The seats by which `instructions` bend it lie this far from the touched places, square to the
  /// rod, to where the pointer pointed. Absent: along the planned screws.
  std::optional<double> seat_by_pointer_m;
  /// Whether it will lie in the true heads; `least_sure` is a head, in order of first touch. Absent
  /// without instructions.
  std::optional<nav::RodExpectation> expected;
  std::optional<Timestamp> first_touch;  ///< of a head
  std::optional<double> took_s;          ///< from then until it was done
  bool done = false;
  /// Finished, and the map has moved since: kept for the report, shown nowhere.
  bool map_moved = false;

  [[nodiscard]] bool visible() const { return !heads.empty() && !map_moved; }
};

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
  /// In `placed`, the wire as it was measured; null before that.
  const PlacedWire* wire = nullptr;
  std::span<const RodState> rods;
  bool rods_moved_away = false;
  std::span<const ToolSight> tools;
  /// The patient reference that World is attached to; null if World is the headset's map itself.
  const nav::Anchor* anchor = nullptr;
  /// The head's pose in the newest pair with a known one; some holograms face it.
  std::optional<Transform<World, Rig>> head;
  bool twin = false;     ///< the virtual twin was asked for
  bool numbers = false;  ///< every number of the guide was asked for
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
