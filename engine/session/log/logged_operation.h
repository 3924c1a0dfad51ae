#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/io/record_log.h"
#include "engine/session/calibration_in_use.h"
#include "engine/session/guide_checks.h"
#include "engine/session/log/operation_identity.h"
#include "engine/session/operation_state.h"
#include "engine/session/workflow/workflow.h"
#include "nav/registration/digitizer.h"
#include "nav/tracking/tool_tracker.h"

namespace orthonav::engine {

/// The subject of a record in the log of an operation. The numbers are stored in files, so none may
/// ever change its meaning.
enum class OperationRecord : std::uint16_t {
  kBegun = 1,
  kRegion = 2,
  kRegionDropped = 3,
  kRegistration = 4,
  kCheckPoint = 5,
  kCheckPointDropped = 6,
  kAccepted = 7,
  kAcceptanceWithdrawn = 8,
  kLevelCleared = 9,
  kPlacesForgotten = 10,
  kLandmark = 11,
  kLandmarkDropped = 12,
  kWire = 13,
  kPlan = 14,  ///< the plan of a level's screws, after one was changed or redone
  kScrew = 15,
  kHead = 16,
  kHeadDropped = 17,
  kRod = 18,
  kReferences = 19,
  kTips = 20,  ///< the guide's tip against the pointer's, or corrected by it
  kResumed = 21,
  kEnded = 22,
  kAxis = 23,      ///< the guide's axis against a wire, or corrected by it
  kRestored = 24,  ///< a registration of an earlier program, as the one that resumed has it
  kCalibration = 25,
  kEvent = 26,  ///< with the workflow's answer to it
  kAsked = 27,  ///< by another program
  kNotUnderstood = 28,
};
inline constexpr std::uint16_t kOperationRecords = 28;
/// What a record is about, as people read it: "check point".
[[nodiscard]] std::string_view name_of(OperationRecord record);
/// Of each record. Those of version 1 told less, and a journal beside them the rest.
inline constexpr std::uint16_t kOperationRecordVersion = 2;

/// One requested registration.
struct LoggedRegistration {
  Timestamp time{};
  std::size_t level = 0;
  int attempt = 0;
  bool passed = false;
  std::string reason;                       ///< why not
  std::optional<TagSizeWarning> tag_size;   ///< of the pointer it was made with
  std::optional<nav::Registration> result;  ///< absent: none was found
};

/// One touch of a level's landmark.
struct LoggedTouch {
  LandmarkTouch touch;
  bool dropped = false;  ///< taken back
};

/// An operation as its log tells it: resuming takes its state, reports all of it.
struct LoggedOperation {
  OperationIdentity identity;
  /// Without models, and without what follows from them. A registration has the points that it
  /// was computed from only if they are the strokes in the log; a rod has of its template and its
  /// instructions what reports have.
  OperationState state;
  std::vector<std::vector<nav::Region>> strokes;  ///< saved regions, level by level
  std::vector<nav::ReferencePlace> references;
  bool guide_corrected = false;
  bool done = false;   ///< completed
  bool ended = false;  ///< in order, done or not; else its program was killed, or still runs
  std::string reason;  ///< why it ended without being done
  int resumed = 0;     ///< number of times

  // What happened on the way there.
  std::vector<LoggedRegistration> registrations;
  /// Level by level, also those of discarded registrations, since they show why.
  std::vector<std::vector<LoggedTouch>> landmark_touches;
  std::optional<TipDifference> tips;  ///< as last compared
  std::optional<AxisDifference> axis;
  std::optional<CalibrationInUse> calibration;  ///< as found out by the newest screw
  /// The workflow reached this step.
  struct ReachedStep {
    Timestamp time{};
    Step step = Step::kSetup;
  };
  std::vector<ReachedStep> steps;
  /// Of the first and the last record with a time, on the clock of the device since the newest
  /// program began.
  std::optional<Timestamp> first_time;
  std::optional<Timestamp> last_time;
  std::size_t records = 0;
  std::size_t dropped_bytes = 0;  ///< after the last whole record

  /// Reads a log and changes nothing, not even a lock. A one-line Error if it can't be read, is of
  /// an earlier version, or holds no record.
  static Result<LoggedOperation> read(Env& env, const std::string& path);
  /// Refuses records that are not those of an operation, with a one-line Error that holds `name`,
  /// the file they were read from, and the number of the record.
  static Result<LoggedOperation> from(const std::vector<Record>& records, const std::string& name);
  /// Reduces the operation to what another program can continue. Drops check points and the heads
  /// of an unfinished rod, which are touched again, and without a patient reference everything
  /// measured in World.
  void reopen();
  void forget_places();
};

}  // namespace orthonav::engine
