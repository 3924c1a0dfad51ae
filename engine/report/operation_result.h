#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "engine/live/frame_loop.h"
#include "engine/report/registration_figures.h"
#include "engine/session/calibration_in_use.h"
#include "engine/session/guidance.h"
#include "engine/session/known_errors.h"
#include "engine/session/log/session_observer.h"
#include "engine/session/operation_state.h"
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

/// What only a simulation or an evaluation knows of a screw.
struct ScrewTruth {
  /// Whether its wire is known; without it, only `guided` may be.
  bool known = false;
  double angle_error_rad = 0.0;
  std::optional<double> entry_error_m = {};  ///< absent: the wire misses the bone
  /// For a screw replanned in surgery, relative to the plan before surgery.
  std::optional<double> preoperative_angle_error_rad = {};
  std::optional<double> preoperative_entry_error_m = {};
  /// The planned screw along the wire, and its clearance; absent: past the bone, or no radius.
  std::optional<nav::ScrewCylinder> driven = {};
  std::optional<nav::Clearance> clearance = {};
  /// At the moment the wire pierced the bone.
  std::optional<GuidedError> guided = {};
};

struct LevelTruth {
  std::optional<double> tre_m;  ///< mean over the entries and targets of the level's screws
  /// For each of these places, screw by screw: from the true to the registered one, in the
  /// vertebra's axes (LPS).
  std::vector<Vec3> errors_m;
  std::vector<ScrewTruth> screws;  ///< as many as in the plan, in its order
};

struct RodTruth {
  std::optional<double> length_error_m;  ///< template relative to the spline through the true heads
  std::optional<double> head_error_m;    ///< mean distance of a touched head from the true one
};

/// For every level, screw and rod of an `OperationState`, in its order.
struct OperationTruth {
  std::vector<LevelTruth> levels;
  std::array<RodTruth, 2> rods;
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
  OperationState state;
  OperationTruth truth;                         ///< of the state; empty values where none is known
  std::optional<CalibrationInUse> calibration;  ///< absent: not requested
  LoopReport loop;
  Status recording;  ///< why the session's recording is incomplete, if one was requested
  std::optional<RecordedPairs> recorded;  ///< absent: no device's own pairs were recorded
};

/// The result from the session alone, without the truth.
[[nodiscard]] OperationResult result_of(OperationState state, LoopReport loop);

/// The newest registration that found a pose, whether it passed or not.
[[nodiscard]] std::optional<RegisteredLevel> registered_level(const LevelState& level);
/// Where the planned screw went: along the true wire or, where that is not known, along the tool as
/// tracked. Absent: not done, not measured, past the bone, or the plan states no radius.
[[nodiscard]] std::optional<nav::ScrewCylinder> driven_screw(const LevelState& level,
                                                             std::size_t screw,
                                                             const ScrewTruth& truth);
/// Whether the rod was touched or planned.
[[nodiscard]] bool has_rod(const OperationState& state, const RodState& rod);

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
