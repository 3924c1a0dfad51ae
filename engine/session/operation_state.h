#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "base/time.h"
#include "engine/case/operation.h"
#include "engine/session/landmark.h"
#include "engine/session/placed_wire.h"
#include "engine/session/touched_heads.h"
#include "nav/guidance/executed_trajectory.h"
#include "nav/guidance/predicted_error.h"
#include "nav/guidance/rod.h"
#include "nav/guidance/rod_bends.h"
#include "nav/guidance/rod_expectation.h"
#include "nav/guidance/screw.h"
#include "nav/guidance/screw_clearance.h"
#include "nav/registration/check_points.h"
#include "nav/registration/registration.h"

namespace orthonav::engine {

/// When the bone was last found where its registration puts it, by check points or by its landmark.
struct BoneFound {
  Timestamp time{};
  /// SD along an axis of its offset then, beyond the registration's own uncertainty.
  double sd_m = 0.0;
  /// SD along an axis by which World drifts in the second after.
  double drift_m_per_sqrt_s = 0.0;

  /// From World's drift since then alone, and including the offset at that time.
  [[nodiscard]] double drift_sd_m(Timestamp now) const;
  [[nodiscard]] double sd_at_m(Timestamp now) const;
};

/// After the landmark was recorded, or found where it was. Recording does not show how far World
/// has drifted by then. Finding it again does: the new SD combines its offset along an axis, the SD
/// of the distance between the two places, and the bone's SD when the landmark was recorded.
[[nodiscard]] BoneFound found_by_landmark(const BoneFound& before, const LandmarkTouch& touch,
                                          const Landmark& landmark, Timestamp now);

/// How the registration of a level went.
struct RegistrationOutcome {
  std::optional<nav::Registration> result;  ///< absent: none was found
  std::optional<Error> error;               ///< why none was found
  /// It may be verified: it passed its limits, or may still pass by what is touched to verify it.
  [[nodiscard]] bool passed() const { return result && (result->accepted || provisional); }
  bool provisional = false;  ///< may pass once verified by touch
};

// The state of an operation: what was registered, placed and bent. The session changes it, its log
// restores it, the reports are made of it.

/// A registration, passed or not, with the points it was computed from.
struct RegistrationAttempt {
  std::vector<Point<World>> points;
  nav::Registration registration;
  std::size_t left_out = 0;  ///< earlier points of the level, which were refused
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

/// The state of one planned screw. The plan in use is that of its level.
struct ScrewState {
  nav::ScrewPlan preoperative;  ///< as planned before surgery; never changed
  /// The plan in use before each of its changes that was not undone, the newest last. Once the
  /// screw was redone, the first is the plan of the old hole, to which there is no return.
  std::vector<nav::ScrewPlan> earlier_plans;
  int redone = 0;  ///< number of times; the plan in use has the newest entry
  bool done = false;
  // Once it is done:
  std::optional<Timestamp> done_at;
  /// The tool against the plan as last measured at its depth; absent if it never was there.
  std::optional<nav::ScrewGuidance> at_depth;
  /// Of the planned screw along the tool as last measured at depth.
  std::optional<nav::ScrewClearance> clearance_at_depth;
  std::optional<nav::ExecutedTrajectory> executed;  ///< where its tool went, as tracked
  WireOutcome wire;

  [[nodiscard]] bool replanned() const { return !earlier_plans.empty(); }
  [[nodiscard]] bool can_undo() const { return earlier_plans.size() > (redone > 0 ? 1U : 0U); }
};

/// The state of one level of the operation.
struct LevelState {
  /// Its screws are the plan in use everywhere; only Replanning and a redo change them.
  OperatedLevel plan;
  std::vector<ScrewState> screws;  ///< as many as in the plan, in its order
  int attempts = 0;                ///< registrations asked for so far
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
  /// Finished, and the map has moved since: kept for the report, shown nowhere.
  bool map_moved = false;

  [[nodiscard]] bool finished() const { return std::ranges::all_of(screws, &ScrewState::done); }
  /// The first screw that is not done; none if all are.
  [[nodiscard]] std::optional<std::size_t> open_screw() const {
    const auto open = std::ranges::find(screws, false, &ScrewState::done);
    return open == screws.end() ? std::nullopt
                                : std::optional(static_cast<std::size_t>(open - screws.begin()));
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
  [[nodiscard]] double drift_sd_m(Timestamp now) const {
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

/// The levels in the order of the operation, and both rods.
struct OperationState {
  std::vector<LevelState> levels;
  std::array<RodState, 2> rods = {RodState{.side = nav::Side::kLeft},
                                  RodState{.side = nav::Side::kRight}};

  /// World was replaced, or the references that attach it to the patient moved: everything measured
  /// in it is gone. What was done to the patient, and its measurements, stay for the report.
  void forget_places();
  /// An unfinished rod begins anew.
  void forget_open_rods();
};

/// A level of which nothing is done yet.
[[nodiscard]] LevelState planned_level(OperatedLevel plan);

}  // namespace orthonav::engine
