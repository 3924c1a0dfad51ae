#include "engine/session/log/logged_operation.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include "engine/session/log/operation_json.h"
#include "engine/session/steps/digitizing.h"
#include "engine/session/steps/guiding.h"
#include "engine/session/steps/landmarking.h"
#include "engine/session/steps/placing.h"
#include "engine/session/steps/replanning.h"
#include "engine/session/steps/rod_templating.h"
#include "engine/session/steps/verifying.h"

namespace orthonav::engine {
namespace {

/// Of a record that happened on the device's clock; nothing for others.
std::optional<Timestamp> time_of(const JsonNode& node) {
  if (!node.has("time_ns")) {
    return std::nullopt;
  }
  // Larger times in nanoseconds are invalid.
  constexpr double kLatest_ns = 4e18;
  const double ns = node.number("time_ns");
  if (!(std::abs(ns) <= kLatest_ns)) {
    node.refuse("time_ns", "is not a time of an operation");
    return std::nullopt;
  }
  return Timestamp(Duration(static_cast<std::int64_t>(ns)));
}

/// Applies one record; errors are noted in its document.
class Applied {
 public:
  Applied(LoggedOperation& operation, OperationRecord type, const JsonNode& node)
      : operation_(operation), type_(type), node_(node) {}

  void apply() {
    using enum OperationRecord;
    if (const auto time = time_of(node_)) {
      time_ = *time;
      operation_.first_time = std::min(time_, operation_.first_time.value_or(time_));
      operation_.last_time = std::max(time_, operation_.last_time.value_or(time_));
    }
    switch (type_) {
      case kBegun:
        return begin();
      case kPlacesForgotten:
        return operation_.forget_places();
      case kReferences:
        operation_.references.clear();
        for (const JsonNode& place : node_.list("places")) {
          operation_.references.push_back(place_from(place));
        }
        return;
      case kTips:
        operation_.tips = tips_from(node_);
        operation_.guide_corrected = operation_.guide_corrected || operation_.tips->corrected;
        return;
      case kAxis:
        operation_.axis = axis_from(node_);
        operation_.guide_corrected = operation_.guide_corrected || operation_.axis->corrected;
        return;
      case kCalibration:
        operation_.calibration = calibration_from(node_.child("found"));
        return;
      case kEvent:
        return reach(named<Step>(node_, "next", kStepCount));
      case kAsked:
      case kNotUnderstood:
        return;  // for people
      case kResumed:
        return operation_.reopen();
      case kEnded:
        operation_.ended = true;
        operation_.done = node_.flag_or("done", false);
        operation_.reason = node_.text("reason");
        return;
      case kHead:
      case kHeadDropped:
      case kRod:
        return apply_to_rod();
      case kRegion:
      case kRegionDropped:
      case kRegistration:
      case kRestored:
      case kCheckPoint:
      case kCheckPointDropped:
      case kAccepted:
      case kAcceptanceWithdrawn:
      case kLandmark:
      case kLandmarkDropped:
      case kLevelCleared:
      case kPlan:
      case kWire:
      case kScrew:
        return apply_to_level();
    }
  }

 private:
  void begin() {
    operation_.identity = identity_from(node_);
    for (const JsonNode& planned : node_.list("plan")) {
      OperatedLevel plan;
      plan.label = planned.text("label");
      for (const JsonNode& screw : planned.list("screws")) {
        plan.screws.push_back(screw_from(screw));
      }
      operation_.state.levels.push_back(planned_level(std::move(plan)));
    }
    operation_.strokes.resize(operation_.state.levels.size());
    operation_.landmark_touches.resize(operation_.state.levels.size());
  }

  void reach(Step step) {
    if (operation_.steps.empty() || operation_.steps.back().step != step) {
      operation_.steps.push_back({time_, step});
    }
  }

  void apply_to_rod() {
    RodState& rod = operation_.state.rods[side_from(node_) == Side::kRight ? 1 : 0];
    if (type_ == OperationRecord::kRod) {
      return read_rod(node_, rod);
    }
    const bool dropped = type_ == OperationRecord::kHeadDropped;
    read_head(node_, dropped, operation_.identity.patient_reference, rod);
  }

  void apply_to_level() {
    const auto index = static_cast<std::size_t>(node_.unsigned_integer("level"));
    const std::size_t levels = operation_.state.levels.size();
    if (index >= levels) {
      node_.refuse("level", "must be below " + std::to_string(levels));
      return;
    }
    apply_to(index);
  }

  void apply_to(std::size_t index) {
    using enum OperationRecord;
    LevelState& level = operation_.state.levels[index];
    std::vector<nav::Region>& strokes = operation_.strokes[index];
    switch (type_) {
      case kRegion:
        return read_region(node_, strokes);
      case kRegionDropped:
        return read_region_dropped(node_, strokes);
      case kRegistration:
        operation_.registrations.push_back(read_registration(node_, level, strokes));
        operation_.registrations.back().time = time_;
        operation_.registrations.back().level = index;
        return;
      case kRestored:
        level.accepted = level.registration && node_.flag_or("accepted", false);
        return;
      case kAccepted:
        return read_acceptance(node_, level);
      case kAcceptanceWithdrawn:
        return read_acceptance_withdrawn(level);
      case kLevelCleared:
        return read_level_cleared(level, strokes);
      case kPlan:
        return read_plan(node_, level);
      case kWire:
      case kScrew:
        return apply_to_screw(level);
      case kCheckPoint:
        return read_check_point(node_, level);
      case kCheckPointDropped:
        return read_check_point_dropped(level);
      case kLandmark:
        operation_.landmark_touches[index].push_back({read_landmark_touch(node_, level)});
        return;
      case kLandmarkDropped:
        read_landmark_dropped(node_, level);
        if (!operation_.landmark_touches[index].empty()) {
          operation_.landmark_touches[index].back().dropped = true;
        }
        return;
      case kBegun:
      case kPlacesForgotten:
      case kReferences:
      case kTips:
      case kAxis:
      case kCalibration:
      case kEvent:
      case kAsked:
      case kNotUnderstood:
      case kResumed:
      case kEnded:
      case kHead:
      case kHeadDropped:
      case kRod:
        return;  // of no level
    }
  }

  void apply_to_screw(LevelState& level) const {
    const auto index = static_cast<std::size_t>(node_.unsigned_integer("screw"));
    if (index >= level.screws.size()) {
      node_.refuse("screw", "must be below " + std::to_string(level.screws.size()));
      return;
    }
    ScrewState& screw = level.screws[index];
    if (type_ == OperationRecord::kWire) {
      return read_wire(node_, screw);
    }
    read_screw(node_, time_, screw);
  }

  LoggedOperation& operation_;
  OperationRecord type_;
  const JsonNode& node_;
  Timestamp time_{};
};

Status applied(LoggedOperation& operation, const Record& record, const std::string& name) {
  const std::string where = name + ": record " + std::to_string(record.number);
  if (record.version == 1) {
    return Error{where + ": is of an earlier version of orthonav, which alone reads it"};
  }
  if (record.type < static_cast<std::uint16_t>(OperationRecord::kBegun) ||
      record.type > kOperationRecords || record.version != kOperationRecordVersion) {
    return Error{where + ": is of a sort that this program does not know (type " +
                 std::to_string(record.type) + ", version " + std::to_string(record.version) + ")"};
  }
  const auto document = JsonDocument::parse(record.payload, where);
  if (!document) {
    return document.error();
  }
  const auto type = static_cast<OperationRecord>(record.type);
  if ((type == OperationRecord::kBegun) != (record.number == 1)) {
    return Error{where + ": an operation begins with its first record and only once"};
  }
  const JsonNode root = document->root();
  Applied(operation, type, root).apply();
  return document->status();
}

}  // namespace

std::string_view name_of(OperationRecord record) {
  constexpr std::string_view kNames[kOperationRecords] = {"begun",
                                                          "region",
                                                          "region dropped",
                                                          "registration",
                                                          "check point",
                                                          "check point dropped",
                                                          "accepted",
                                                          "acceptance withdrawn",
                                                          "level cleared",
                                                          "places forgotten",
                                                          "landmark",
                                                          "landmark dropped",
                                                          "wire",
                                                          "plan",
                                                          "screw",
                                                          "head",
                                                          "head dropped",
                                                          "rod",
                                                          "references",
                                                          "tips",
                                                          "resumed",
                                                          "ended",
                                                          "axis",
                                                          "restored",
                                                          "calibration",
                                                          "event",
                                                          "asked from outside",
                                                          "not understood"};
  return kNames[static_cast<std::size_t>(record) - 1];
}

void LoggedOperation::forget_places() {
  state.forget_places();
  for (LevelState& level : state.levels) {
    level.newest.reset();
  }
  for (std::vector<nav::Region>& of_level : strokes) {
    of_level.clear();
  }
}

void LoggedOperation::reopen() {
  ++resumed;
  done = ended = false;
  reason.clear();
  guide_corrected = false;
  first_time.reset();
  last_time.reset();
  if (!identity.patient_reference) {
    forget_places();
  }
  for (LevelState& level : state.levels) {
    level.check_points.clear();
    for (ScrewState& screw : level.screws) {
      if (!screw.done) {
        screw.wire = {};  // it is guided, and its wire measured, once more
      }
    }
  }
  state.forget_open_rods();
}

Result<LoggedOperation> LoggedOperation::read(Env& env, const std::string& path) {
  const auto read = read_log(env, path);
  if (!read) {
    return read.error();
  }
  if (read->records.empty()) {
    return Error{path + ": holds no whole record of an operation"};
  }
  auto operation = from(read->records, path);
  if (operation) {
    operation->dropped_bytes = read->dropped_bytes;
  }
  return operation;
}

Result<LoggedOperation> LoggedOperation::from(const std::vector<Record>& records,
                                              const std::string& name) {
  LoggedOperation operation;
  operation.records = records.size();
  for (const Record& record : records) {
    if (const Status good = applied(operation, record, name); !good) {
      return good.error();
    }
  }
  for (LevelState& level : operation.state.levels) {
    if (level.registration) {
      level.predicted = nav::predicted_errors(*level.registration, level.plan.screws);
    }
  }
  return operation;
}

}  // namespace orthonav::engine
