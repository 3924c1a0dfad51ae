#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "engine/io/records.h"
#include "engine/session/guidance.h"
#include "engine/session/operation_identity.h"

namespace orthonav::engine {

/// What a record of the log of an operation is about. The numbers stand in files: none may ever
/// change its meaning.
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
  kPlan = 14,  ///< of a level's screws, after one was changed or redone
  kScrew = 15,
  kHead = 16,
  kHeadDropped = 17,
  kRod = 18,
  kReferences = 19,
  kGuide = 20,  ///< its tip or its axis was corrected
  kResumed = 21,
  kEnded = 22,
};
inline constexpr std::uint16_t kOperationRecordVersion = 1;

struct LoggedScrew {
  nav::ScrewPlan plan;  ///< in use
  std::vector<nav::ScrewPlan> earlier;
  int redone = 0;
  bool done = false;
  std::optional<nav::ExecutedTrajectory> executed;
  std::optional<nav::ScrewClearance> clearance;
  bool wire_asked = false;
  std::optional<PlacedWire> wire;
};

struct LoggedLevel {
  std::string label;
  std::vector<nav::Region> regions;  ///< saved
  int attempts = 0;
  std::optional<nav::Registration> registration;  ///< that passed
  std::string points_hash;                        ///< of the points it was computed from
  bool accepted = false;
  std::size_t check_points = 0;
  std::optional<Landmark> landmark;
  std::vector<LoggedScrew> screws;

  [[nodiscard]] bool finished() const;
  /// Of the saved regions, in their order.
  [[nodiscard]] std::vector<Point<World>> points() const;
};

struct LoggedRod {
  std::size_t heads = 0;
  bool done = false;
};

/// An operation as its log tells it, record by record.
struct LoggedOperation {
  OperationIdentity identity;
  std::vector<LoggedLevel> levels;
  std::array<LoggedRod, 2> rods;  ///< left, right
  std::vector<nav::ReferencePlace> references;
  bool guide_corrected = false;
  bool done = false;  ///< to its end
  int resumed = 0;    ///< how many times

  /// Refuses records that are not those of an operation, in one line with `name`, the file they
  /// were read from, and the number of the record.
  static Result<LoggedOperation> from(const std::vector<Record>& records, const std::string& name);
  /// Becomes what another program can continue: without a patient reference nothing measured in
  /// World; no check points, and no heads of an unfinished rod, which are touched again.
  void go_on();
  void forget_places();
};

}  // namespace orthonav::engine
