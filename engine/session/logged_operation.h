#pragma once

#include <string>
#include <vector>

#include "engine/io/records.h"
#include "engine/session/operation_identity.h"
#include "engine/session/operation_state.h"
#include "nav/registration/digitizer.h"
#include "nav/tracking/anchor.h"

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
  kGuide = 20,  ///< the guide's tip or axis was corrected
  kResumed = 21,
  kEnded = 22,
};
inline constexpr std::uint16_t kOperationRecordVersion = 1;

/// An operation as its log tells it.
struct LoggedOperation {
  OperationIdentity identity;
  /// Without models, and without what follows from the rest. A registration has the points that it
  /// was computed from only if they are the strokes in the log; of a rod only the number of its
  /// heads is told, and whether it is done.
  OperationState state;
  std::vector<std::vector<nav::Region>> strokes;  ///< saved regions, level by level
  std::vector<nav::ReferencePlace> references;
  bool guide_corrected = false;
  bool done = false;  ///< completed
  int resumed = 0;    ///< number of times

  /// Refuses records that are not those of an operation, with a one-line Error that holds `name`,
  /// the file they were read from, and the number of the record.
  static Result<LoggedOperation> from(const std::vector<Record>& records, const std::string& name);
  /// Reduces the operation to what another program can continue. Drops check points and the heads
  /// of an unfinished rod, which are touched again, and without a patient reference everything
  /// measured in World.
  void go_on();
  void forget_places();
};

}  // namespace orthonav::engine
