#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/live/frame_loop.h"
#include "engine/report/registration_figures.h"
#include "engine/session/calibration_in_use.h"
#include "engine/session/guidance.h"
#include "engine/session/known_errors.h"
#include "engine/session/log/session_observer.h"
#include "nav/guidance/changed_screw.h"
#include "nav/guidance/screw_cylinder.h"

namespace orthonav::engine {

/// The tracked and registered guide compared with the true one, in its vertebra's frame.
struct GuidedError {
  double tip_m = 0.0;      ///< distance of the two tips
  double across_m = 0.0;   ///< its component across the planned axis
  double angle_rad = 0.0;  ///< between the two axes
  /// `across_m` in displayed SDs of the two offsets: 68 % should lie within 1.51, 95 % within 2.45.
  /// Absent: no SD was shown.
  std::optional<double> across_sds = {};
  bool sure = false;  ///< both offsets were shown as sure
};

struct ScrewOutcome {
  nav::Side side = nav::Side::kLeft;
  bool done = false;                      ///< as declared by the surgeon
  std::optional<double> angle_error_rad;  ///< relative to the truth, if known
  std::optional<double> entry_error_m;    ///< also absent if the wire misses the bone
  std::string accepted_breach = {};       ///< why the plan may leave the cortex, if stated
  /// As planned, with the spread that the registration leaves for an exactly guided screw; absent
  /// if the plan states no radius.
  std::optional<nav::ScrewClearance> planned = {};
  /// How the plan was changed in surgery, relative to the earlier one; absent: unchanged.
  std::optional<nav::ScrewDifference> planned_in_surgery = {};
  /// The least depth of the planned screw about every 2 mm from 6 mm past the entry to the tip.
  std::vector<double> planned_profile_m = {};
  /// Along the tool as tracked at depth, with the spread from registration and tracking.
  std::optional<nav::ScrewClearance> tracked = {};
  /// True clearance of the planned screw along the executed axis.
  std::optional<nav::Clearance> executed = {};
  /// Where its tool went, as tracked; absent for a finished screw: not measured.
  std::optional<nav::ExecutedTrajectory> trajectory = {};
  WireOutcome wire = {};  ///< as measured in place
  int redone = 0;         ///< number of times through another entry
  /// At the moment the wire pierced the bone, if the truth is known.
  std::optional<GuidedError> guided = {};
  /// For a screw replanned in surgery, relative to the plan before surgery.
  std::optional<double> preoperative_angle_error_rad = {};
  std::optional<double> preoperative_entry_error_m = {};
  std::optional<nav::ScrewCylinder> size = {};  ///< as planned; absent: the plan states no radius
  /// Along the true wire, or where the truth is not known along the tool as tracked; absent: not
  /// done, not measured, or past the bone.
  std::optional<nav::ScrewCylinder> driven = {};
  /// Whether the surgeon was warned of this screw: its wire was measured beyond a limit, its
  /// clearance's 95 % bound is below 0, or its planned breach was accepted.
  [[nodiscard]] bool warned() const;
};

struct LevelOutcome {
  std::string label;
  bool accepted = false;
  int attempts = 0;
  std::optional<double> rmse_m;  ///< absent without an accepted registration
  std::optional<double> tre_m;   ///< mean over the entries and targets of the level's screws
  /// For each of these places, screw by screw: from the true to the registered one, in the
  /// vertebra's axes (LPS).
  std::vector<Vec3> errors_m;
  /// Root mean square error to expect at the worst of the screws' entries and targets.
  std::optional<double> predicted_tre_m;
  bool registration_only = false;  ///< that and the clearances' bounds do not include common errors
                                   ///< of all strokes
  /// Used by that registration; absent without one, as the time is.
  std::optional<std::size_t> points;
  std::optional<double> digitization_s;
  std::vector<double> check_points_m;  ///< signed distances, in the order of touching
  /// The newest registration that found a pose, whether it passed or not.
  std::optional<RegisteredLevel> registered;
  std::vector<ScrewOutcome> screws;
};

struct RodOutcome {
  nav::Side side = nav::Side::kLeft;
  std::size_t heads = 0;
  std::optional<double> length_m;
  std::optional<double> length_error_m;  ///< template relative to the spline through the true heads
  std::optional<double> head_error_m;    ///< mean distance of a touched head from the true one
  std::optional<double> took_s = {};     ///< from the first touch of a head until it was done
  std::optional<nav::RodInstructions> instructions = {};
  std::string no_instructions = {};              ///< why there are none
  std::optional<double> seat_by_pointer_m = {};  ///< as `RodState` has it
};

/// The pairs of an operation that was recorded.
struct RecordedPairs {
  std::int64_t received = 0;  ///< from the cameras
  std::int64_t lost = 0;      ///< of these, not in the recording, since the disk was too slow
};

/// The measured result of one operation. Values that depend on the machine's speed are only in
/// `loop`.
struct OperationResult {
  std::string method;
  std::optional<std::uint64_t> seed;  ///< absent without random draws: a real headset
  std::string case_name;
  std::string instrument;             ///< of the simulated surgeon; empty: not known
  bool patient_reference = false;     ///< World was relative to one instead of the headset's map
  std::optional<ErrorsInUse> errors;  ///< that all strokes share, as the operation counted with
  /// Every level accepted, every screw done, the rods too; of rods alone, at least one.
  bool completed = false;
  /// If not completed, where it ended and the last refusal: "ended at digitize L4: registration
  /// RMSE 3.4 mm, limit 3.0 mm". Empty when it completed.
  std::string why_not;
  std::vector<LevelOutcome> levels;
  std::optional<CalibrationInUse> calibration;  ///< absent: not requested
  std::vector<RodOutcome> rods;                 ///< empty if no side has two screws
  LoopReport loop;
  Status recording;  ///< why the session's recording is incomplete, if one was requested
  std::optional<RecordedPairs> recorded;  ///< absent: no device's own pairs were recorded
};

/// The outcome from the session alone, without the truth.
[[nodiscard]] OperationResult outcome_of(std::span<const LevelState> levels,
                                         std::span<const RodState> rods, LoopReport loop);

/// Remembers the current step of an operation and why its last registration was refused.
class EndNote : public SessionObserver {
 public:
  void happened(Timestamp time, Step from, Event event, Cell answer) override;
  void registered(Timestamp time, const LevelState& level,
                  const RegistrationOutcome& outcome) override;
  /// If the operation did not complete, writes into the result why.
  void explain(OperationResult& result) const;

 private:
  Step step_ = Step::kSetup;
  std::string refused_;  ///< "L4 refused: ..."; empty when the last registration passed
};

/// The value that `fraction` of the values lie at or below (nearest rank); nothing without values.
[[nodiscard]] std::optional<double> quantile(std::vector<double> values, double fraction);

/// report.json as docs/file-formats.md describes it: deterministic bytes for equal results.
[[nodiscard]] std::string report_json(const OperationResult& result);
[[nodiscard]] nlohmann::ordered_json report_of(const OperationResult& result);
/// Wall times of the run, which differ from machine to machine.
[[nodiscard]] std::string timing_json(const LoopReport& loop);

}  // namespace orthonav::engine
