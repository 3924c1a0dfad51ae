#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/side.h"
#include "base/time.h"
#include "engine/session/calibration_in_use.h"
#include "engine/session/known_errors.h"
#include "engine/session/workflow.h"
#include "nav/guidance/changed_screw.h"
#include "nav/guidance/executed_trajectory.h"

namespace orthonav::engine {

/// The tool relative to its screw, as measured at depth.
struct RecordedPose {
  double angle_rad = 0.0;
  double tip_to_entry_m = 0.0;
  double tip_off_axis_m = 0.0;
  double depth_m = 0.0;
  std::optional<double> clearance_m;  ///< of the planned screw along the tool
  std::optional<double> clearance_95_m;
  std::string grade;  ///< of the clearance; empty: not recorded
  std::optional<std::array<double, nav::kPedicleGrades>> grade_probability;  ///< A to E
};

/// A placed wire as measured.
struct RecordedWire {
  double angle_rad = 0.0;
  double angle_sd_rad = 0.0;
  double entry_m = 0.0;
  double entry_sd_m = 0.0;
  bool within = false;  ///< both limits
  bool kept = false;    ///< by the surgeon's decision, although beyond a limit
};

struct RecordedScrew {
  Side side = Side::kLeft;
  bool done = false;
  std::optional<Timestamp> time;         ///< when it was declared done
  std::optional<RecordedPose> at_depth;  ///< absent if the tool never was at its depth
  std::optional<nav::ExecutedTrajectory> executed = {};  ///< where its tool went, as tracked
  /// Which of these the session did not measure; empty in older journals.
  std::vector<std::string> not_measured = {};
  bool wire_asked =
      false;  ///< its wire was to be measured before it was done; not in older journals
  std::optional<RecordedWire> wire = {};  ///< as last measured, of the newest entry
  int redone = 0;                         ///< number of times, through another entry
  /// How its plan in surgery differs from the preoperative one; absent: unchanged.
  std::optional<nav::ScrewDifference> planned_in_surgery = {};
};

/// One requested registration. What the journal does not hold is absent.
struct RecordedRegistration {
  Timestamp time{};
  std::string level;
  int attempt = 0;
  bool passed = false;
  bool accepted_earlier = false;  ///< of a resumed operation: in the session that made it
  std::string reason;             ///< why not
  std::string warning;            ///< about the pointer it was made with
  std::optional<std::size_t> points;
  std::optional<double> rmse_m;
  std::optional<double> runner_up_rmse_m;
  std::optional<double> predicted_tre_m;  ///< at the worst of the screws; passed ones only
  std::optional<double> tre_95_m;
  /// These leave out the errors common to all strokes; absent in older journals.
  std::optional<bool> registration_only = {};
};

struct RecordedCheck {
  double distance_m = 0.0;  ///< positive outside the bone
  bool within = false;      ///< the limit
};

/// The guide's tip compared with the pointer's in the same dimple.
struct RecordedTips {
  double apart_m = 0.0;
  double limit_m = 0.0;
  double by_m = 0.0;  ///< what a correction takes away
  bool corrected = false;
};

/// The guide's axis compared with a wire in its sleeve.
struct RecordedAxis {
  double off_rad = 0.0;
  double sd_rad = 0.0;
  double by_rad = 0.0;  ///< what a correction takes away
  bool corrected = false;
};

/// One touch of a level's landmark.
struct RecordedLandmark {
  bool first = false;  ///< it recorded the landmark
  double off_m = 0.0;  ///< from where it was recorded
  double limit_m = 0.0;
  bool within = false;   ///< the limit
  bool dropped = false;  ///< taken back
};

/// One level, in its state when the journal ended.
struct RecordedLevel {
  std::string label;
  int attempts = 0;
  bool accepted = false;
  bool finished = false;                    ///< the workflow went on from it
  std::optional<std::size_t> registration;  ///< in force; of SessionRecord::registrations
  std::optional<double> digitization_s;     ///< of the digitization that led to it
  std::vector<RecordedCheck> checks;        ///< of the registration in force
  /// Every touch of a landmark, including those of discarded registrations, since they show why.
  std::vector<RecordedLandmark> landmark;
  std::vector<RecordedScrew> screws;
};

struct RecordedBend {
  double arc_length_m = 0.0;
  double angle_rad = 0.0;
};

/// One bend as it was instructed.
struct RecordedInstruction {
  double arc_length_m = 0.0;  ///< of its middle, from the first end
  double roll_rad = 0.0;
  double angle_rad = 0.0;
  double set_rad = 0.0;  ///< on the bender
};

/// How a head was touched.
struct RecordedHead {
  std::size_t touches = 0;
  double sd_m = 0.0;  ///< standard error of its place, along an axis
};

struct RecordedRod {
  Side side = Side::kLeft;
  std::size_t heads = 0;
  std::vector<RecordedHead> touched;  ///< head by head; empty in older journals
  bool done = false;
  std::optional<double> length_m;  ///< of the template that was used
  std::vector<RecordedBend> bends;
  std::optional<double> cut_length_m;  ///< absent: there were no instructions
  std::vector<RecordedInstruction> instructions;
  std::string no_instructions;  ///< why not
  /// Probability that every true seat lies within 1.0 mm; absent without instructions, and in older
  /// journals.
  std::optional<double> expected_within;
};

/// The workflow reached this step.
struct RecordedStep {
  Timestamp time{};
  Step step = Step::kSetup;
};

/// A session as reconstructed from its journal.
struct SessionRecord {
  std::string orthonav;  ///< version that wrote it
  std::string device;
  std::string method;
  std::string case_name;
  std::uint64_t seed = 0;  ///< 0 if nothing was random
  /// World was attached to a patient reference instead of to the headset's map; absent in older
  /// journals.
  std::optional<bool> patient_reference;
  std::optional<ErrorsInUse> errors;  ///< that all strokes share; absent in older journals
  bool has_plan = false;  ///< the levels and screws are those of the plan, whether reached or not
  std::size_t lines = 0;  ///< number of lines read, including the header
  bool cut = false;       ///< it has no end: the process was killed, or the machine went down
  bool last_line_torn = false;
  std::optional<Timestamp> begin;  ///< of the first line with a time
  std::optional<Timestamp> end;    ///< of the last one
  std::string reason;              ///< what ended it early; empty: nothing, or `cut`
  std::vector<RecordedLevel> levels;
  std::vector<RecordedRegistration> registrations;
  std::optional<CalibrationInUse> calibration;  ///< after the last screw; absent: not recorded
  std::optional<RecordedTips> tips;             ///< as last compared
  std::optional<RecordedAxis> axis;             ///< likewise
  std::vector<RecordedRod> rods;
  std::vector<RecordedStep> steps;

  [[nodiscard]] bool completed() const { return !cut && reason.empty(); }
};

}  // namespace orthonav::engine
