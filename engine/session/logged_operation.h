#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "engine/io/records.h"
#include "engine/session/guidance.h"
#include "engine/session/operation_identity.h"

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
  std::optional<nav::Registration> registration;  ///< one that passed
  std::string points_hash;                        ///< of the points it was computed from
  bool accepted = false;
  std::size_t check_points = 0;
  std::optional<Landmark> landmark;
  std::vector<LoggedScrew> screws;

  [[nodiscard]] bool finished() const;
  /// The points of the saved regions, in order.
  [[nodiscard]] std::vector<Point<World>> points() const;
};

struct LoggedRod {
  std::size_t heads = 0;
  bool done = false;
};

/// An operation as reconstructed from the records of its log.
struct LoggedOperation {
  OperationIdentity identity;
  std::vector<LoggedLevel> levels;
  std::array<LoggedRod, 2> rods;  ///< left, right
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
