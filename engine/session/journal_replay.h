#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/io/json_document.h"
#include "engine/session/session_record.h"

namespace orthonav::engine {

/// Follows a session by the lines of its journal, as the session itself did (Session::act): which
/// level is current, what a rejection or a moved map revoked. Errors are noted in `line`.
class JournalReplay {
 public:
  explicit JournalReplay(SessionRecord& record) : record_(record) {}

  /// A level of the plan with the sides of its screws.
  void plan(const std::string& label, const std::vector<std::string>& sides, const JsonNode& line);
  void happened(Timestamp time, Event event, Cell answer);
  void registered(RecordedRegistration found, const JsonNode& line);
  /// The uncertainty of the level's registration, which now includes the touched places.
  struct Expected {
    std::optional<double> predicted_tre_m;
    std::optional<double> tre_95_m;
  };
  void accepted(const std::string& label, const Expected& expected, const JsonNode& line);
  void checked(const std::string& label, RecordedCheck check, const JsonNode& line);
  void check_dropped(const std::string& label, const JsonNode& line);
  void landmark(const std::string& label, RecordedLandmark touch, const JsonNode& line);
  void landmark_dropped(const std::string& label, const JsonNode& line);
  void wire_measured(const std::string& label, Side side, const RecordedWire& wire,
                     const JsonNode& line);
  void screw_redone(const std::string& label, Side side, const JsonNode& line);
  /// An absent difference: back to the preoperative plan.
  void replanned(const std::string& label, Side side,
                 const std::optional<nav::ScrewDifference>& difference, const JsonNode& line);
  void screw_done(const std::string& label, const RecordedScrew& screw, const JsonNode& line);
  /// A head was touched, or the last touch taken back.
  void head(Side side, bool touched, const JsonNode& line);
  void rod_done(RecordedRod rod);

 private:
  /// The level of that name, added if the plan does not contain it. Null, with the line refused, if
  /// there are too many.
  RecordedLevel* level_named(const std::string& label, const JsonNode& line);
  /// Null if there is no such level. The screw is added if the plan does not contain it.
  RecordedScrew* screw_of(const std::string& label, Side side, const JsonNode& line);
  RecordedLevel* current();
  RecordedRod& rod_of(Side side);
  void forget_registration(RecordedLevel& level);
  void forget_map();

  SessionRecord& record_;
  std::optional<std::size_t> level_;      ///< registered last
  std::optional<Timestamp> first_press_;  ///< of the digitization under way
};

}  // namespace orthonav::engine
