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
#include "engine/session/workflow.h"
#include "nav/guidance/clearance_spread.h"
#include "nav/guidance/drill_watch.h"
#include "nav/guidance/executed_trajectory.h"
#include "nav/guidance/predicted_error.h"
#include "nav/guidance/rod.h"
#include "nav/guidance/rod_bends.h"
#include "nav/guidance/screw.h"
#include "nav/guidance/screw_numbers.h"
#include "nav/guidance/shown_clearance.h"
#include "nav/registration/check_points.h"
#include "nav/registration/digitizer.h"
#include "nav/registration/registration.h"
#include "nav/tracking/anchor.h"
#include "nav/tracking/tool.h"

namespace orthonav::engine {

/// A registration, passed or not, with the points that it was made of.
struct RegistrationAttempt {
  std::vector<Point<World>> points;
  nav::Registration registration;
};

/// A tag that is not as large as its tool's definition says: larger by `fraction`.
struct TagSizeWarning {
  std::string tool;
  double fraction = 0.0;
};

/// What became of a wire that was placed.
struct WireOutcome {
  bool asked = false;  ///< for a measurement, before the screw was declared done
  std::optional<PlacedWire> measured;
};

/// Where one level of the operation stands.
struct LevelState {
  /// Its screws are the plan in use, for everybody; only Replanning and a redo write to
  /// them.
  OperatedLevel plan;
  /// Its screws as they were planned before surgery. Nothing writes to them.
  std::vector<nav::ScrewPlan> preoperative;
  /// Of each screw, what was in use before each of its changes that was not undone, the newest
  /// last. Once it was redone, the first is that of the hole, to which nobody goes back.
  std::vector<std::vector<nav::ScrewPlan>> earlier_plans;
  int attempts = 0;  ///< registrations asked for so far
  /// The newest registration that passed its limits; gone when the surgeon rejects it.
  std::optional<nav::Registration> registration;
  /// What that registration leaves uncertain, screw by screw.
  std::vector<nav::PredictedScrewError> predicted;
  /// What was touched on that registration to verify it, in order.
  std::vector<nav::CheckPoint> check_points;
  std::optional<TagSizeWarning> tag_size;  ///< with which the newest registration was made
  /// The newest one that found a pose, whatever became of it: reports tell of it.
  std::optional<RegistrationAttempt> newest;
  /// Of the bone, by the registration that it was first touched on; gone with it.
  std::optional<Landmark> landmark;
  /// Where that registration has it; gone with it.
  std::optional<BoneFound> bone_found;
  bool accepted = false;  ///< by the surgeon; only then anything is guided on it
  /// Restored from the log and not verified since: nothing is guided on it until its landmark is
  /// found, or check points pass and "accept" is said.
  bool unverified = false;
  std::optional<Timestamp> first_press;  ///< of the digitization that led to the registration
  double digitization_s = 0.0;           ///< from the first press to the registration
  std::vector<bool> screw_done;
  /// Of each screw that is done: as planned, but along the tool as it was last measured at depth.
  std::vector<std::optional<nav::ScrewClearance>> clearance_at_depth;
  /// Of each screw that is done: where its tool went, as tracked.
  std::vector<std::optional<nav::ExecutedTrajectory>> executed;
  std::vector<WireOutcome> wires;  ///< of each screw that is done
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
  /// The first screw that is not done; none where all are.
  [[nodiscard]] std::optional<std::size_t> open_screw() const {
    const auto open = std::find(screw_done.begin(), screw_done.end(), false);
    return open == screw_done.end()
               ? std::nullopt
               : std::optional(static_cast<std::size_t>(open - screw_done.begin()));
  }
  /// Throws the registration away with what stands on it. Wires driven on it are not undone: what
  /// was done stays.
  void forget_registration() {
    registration.reset();
    predicted.clear();
    check_points.clear();
    landmark.reset();
    bone_found.reset();
    accepted = false;
    unverified = false;
    first_press.reset();
  }
  /// The errors that are expected lack what all strokes share: nobody knows it.
  [[nodiscard]] bool registration_only() const {
    return registration && !(registration->common.sd_m() > 0.0);
  }
  /// SD along an axis by which World may be off the registration since the bone was found.
  [[nodiscard]] double walked_sd_m(Timestamp now) const {
    return bone_found ? bone_found->sd_at_m(now) : 0.0;
  }
  /// World's vertebra may be shown and guided on.
  [[nodiscard]] bool usable() const {
    return accepted && !unverified && registration && !map_moved;
  }
};

/// One rod: the heads as they were touched, the template once there are two, and how to bend it.
struct RodState {
  nav::Side side = nav::Side::kLeft;
  std::vector<Point<World>> heads;
  std::optional<nav::RodTemplate> rod;
  /// How to bend it, with the bender and the material of the options; absent where there is no
  /// template, or `no_instructions` says why.
  std::optional<nav::RodInstructions> instructions;
  std::string no_instructions;
  bool done = false;
  /// Finished, and the map has moved since: kept for the report, shown nowhere.
  bool map_moved = false;

  [[nodiscard]] bool visible() const { return !heads.empty() && !map_moved; }
};

/// How well a tool is seen right now, and where white paper makes a bad background.
struct ToolSight {
  std::string name;
  nav::ToolRole role = nav::ToolRole::kPointer;
  PoseStatus status = PoseStatus::kLost;
  /// Corners of the white paper of each of its tags, as tracked; none while it is lost.
  std::vector<std::array<Point<World>, 4>> papers;
};

/// The tool against the selected screw.
struct ToolGuidance {
  /// From this very stereo pair: what is written as a number. Head motion between then and now has
  /// no part in it. Absent when the tool was not measured in this pair: a prediction is no reading.
  std::optional<nav::ScrewGuidance> measured;
  /// Predicted to the display time: what is drawn over the patient.
  nav::ScrewGuidance shown;
  Timestamp pose_time{};  ///< mid-exposure of the newest pair in which the tool was measured
  /// Of the planned screw if it were driven along the tool's axis as measured in this pair. Absent
  /// too where the plan states no radius, the tool is not held near the plan, or its axis misses
  /// the bone.
  std::optional<nav::ScrewClearance> clearance = {};
  /// Tip and aim in the surgeon's directions, as they are written. Absent with `measured`, and for
  /// a plan whose directions have no such names (`nav::directions_of`).
  std::optional<nav::ScrewNumbers> numbers = {};
  /// `clearance` as it is written, with it.
  std::optional<nav::ShownClearance> shown_clearance = {};
};

/// A region that was deleted a moment ago.
struct DroppedRegion {
  nav::Region region;
  Timestamp dropped_at{};
};

/// Everything that the surgeon may be shown after one stereo pair, as facts;
/// engine/holograms/scene_builder.h decides what becomes visible. The spans look into the session:
/// valid until its next step.
struct Guidance {
  Timestamp frame_time{};    ///< mid-exposure of the pair
  Timestamp display_time{};  ///< of the frame made of this
  Timestamp pose_time{};     ///< of the pair in which the step's tool was last measured
  Step step = Step::kSetup;
  StatusLine status;
  std::span<const LevelState> levels;
  std::size_t level = 0;  ///< being operated, an index into `levels`
  std::size_t screw = 0;  ///< selected, an index into the level's screws (while guiding)
  std::span<const nav::Region> regions;
  const DroppedRegion* dropped = nullptr;
  /// Guidance on a pose older than this, at the display time, is hidden.
  Duration stale_after{};
  Duration fade{};     ///< a deleted path fades for so long
  bool blank = false;  ///< no more pairs will come: nothing may be shown that could go stale
  std::optional<ToolGuidance> tool;  ///< absent: not guiding, or nothing fresh to guide on
  /// While guiding, whether the tool is seen or not: a stop stays while it is hidden.
  nav::DrillView drill;
  /// In `placed`, the wire as it was measured; null before that.
  const PlacedWire* wire = nullptr;
  std::span<const RodState> rods;
  bool rods_moved_away = false;
  std::span<const ToolSight> tools;
  /// The patient reference that World hangs on; null where World is the headset's map itself.
  const nav::Anchor* anchor = nullptr;
  /// Where the head was in the newest pair that told: some holograms face it.
  std::optional<Transform<World, Rig>> head;
  bool twin = false;  ///< the virtual twin was asked for
  /// How far the saved samples lie from the registered surface, region after region; empty without
  /// a registration to be verified.
  std::span<const float> residuals_m;
  /// One a vertex of the level's model: 1 where a pointer could have stroked and none did, 0 where
  /// the bone was stroked or can't be; empty without a registration to be verified.
  std::span<const float> unstroked;
  /// Places of the current level that are still to be touched to verify it.
  std::span<const Point<World>> to_check;
};

}  // namespace orthonav::engine
