#include "engine/session/logged_operation.h"

#include "engine/session/operation_json.h"

namespace orthonav::engine {
namespace {

std::vector<Point<World>> points_of(const std::vector<nav::Region>& strokes) {
  std::vector<Point<World>> points;
  for (const nav::Region& region : strokes) {
    for (const nav::Sample& sample : region.samples) {
      points.push_back(sample.tip_in_world);
    }
  }
  return points;
}

/// Applies one record; errors are noted in its document.
class Applied {
 public:
  Applied(LoggedOperation& operation, OperationRecord type, const JsonNode& node)
      : operation_(operation), type_(type), node_(node) {}

  void apply() {
    using enum OperationRecord;
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
      case kGuide:
        operation_.guide_corrected =
            operation_.guide_corrected || node_.flag_or("corrected", false);
        return;
      case kResumed:
        return operation_.go_on();
      case kEnded:
        operation_.done = node_.flag_or("done", false);
        return;
      case kHead:
      case kHeadDropped:
      case kRod:
        return apply_to_rod();
      case kRegion:
      case kRegionDropped:
      case kRegistration:
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
  }

  void apply_to_rod() {
    RodState& rod = operation_.state.rods[side_from(node_) == Side::kRight ? 1 : 0];
    if (type_ == OperationRecord::kRod) {
      rod.done = true;
    } else {
      rod.heads.resize(heads_after(node_, type_ == OperationRecord::kHead, rod.heads.size()));
    }
  }

  void apply_to_level() {
    const auto index = static_cast<std::size_t>(node_.unsigned_integer("level"));
    const std::size_t levels = operation_.state.levels.size();
    if (index >= levels) {
      node_.refuse("level", "must be below " + std::to_string(levels));
      return;
    }
    apply_to(operation_.state.levels[index], operation_.strokes[index]);
  }

  void apply_to(LevelState& level, std::vector<nav::Region>& strokes) {
    using enum OperationRecord;
    switch (type_) {
      case kRegion:
        strokes.push_back(region_from(node_.child("region")));
        return;
      case kRegionDropped:
        return drop_region(strokes);
      case kRegistration:
        return apply_registration(level, strokes);
      case kAccepted:
        level.registration = registration_from(node_.child("registration"));
        level.accepted = true;
        return;
      case kAcceptanceWithdrawn:
        level.accepted = false;
        level.check_points.clear();
        return;
      case kLevelCleared:
        strokes.clear();
        level.newest.reset();
        return level.forget_registration();
      case kPlan:
        return apply_plan(level);
      case kWire:
      case kScrew:
        return apply_to_screw(level);
      case kCheckPoint:
        level.check_points.push_back(check_point_from(node_));
        return;
      case kCheckPointDropped:
        if (!level.check_points.empty()) {
          level.check_points.pop_back();
        }
        return;
      case kLandmark:
        if (node_.flag_or("first", false)) {
          level.landmark = landmark_from(node_.child("landmark"));
        }
        return;
      case kLandmarkDropped:
        if (!node_.flag_or("stays", false)) {
          level.landmark.reset();
        }
        return;
      case kBegun:
      case kPlacesForgotten:
      case kReferences:
      case kGuide:
      case kResumed:
      case kEnded:
      case kHead:
      case kHeadDropped:
      case kRod:
        return;  // of no level
    }
  }

  void drop_region(std::vector<nav::Region>& strokes) const {
    if (strokes.empty()) {
      node_.refuse("level", "has no region to be deleted");
    } else {
      strokes.pop_back();
    }
  }

  void apply_registration(LevelState& level, const std::vector<nav::Region>& strokes) const {
    level.attempts = node_.integer("attempt");
    if (!node_.flag_or("passed", false)) {
      return;
    }
    level.forget_registration();
    level.registration = registration_from(node_.child("registration"));
    level.newest = {points_of(strokes), *level.registration};
    if (hash_of(level.newest->points) != node_.text("points_hash")) {
      level.newest.reset();
    }
  }

  void apply_plan(LevelState& level) const {
    const std::vector<JsonNode> screws = node_.list("screws");
    if (screws.size() != level.screws.size()) {
      node_.refuse("screws", "must be " + std::to_string(level.screws.size()));
      return;
    }
    for (std::size_t i = 0; i < screws.size(); ++i) {
      level.plan.screws[i] = screw_from(screws[i]);
      level.screws[i].redone = screws[i].integer("redone");
      level.screws[i].earlier_plans.clear();
      for (const JsonNode& earlier : screws[i].list("earlier")) {
        level.screws[i].earlier_plans.push_back(screw_from(earlier));
      }
    }
  }

  void apply_to_screw(LevelState& level) const {
    const auto index = static_cast<std::size_t>(node_.unsigned_integer("screw"));
    if (index >= level.screws.size()) {
      node_.refuse("screw", "must be below " + std::to_string(level.screws.size()));
      return;
    }
    if (type_ == OperationRecord::kWire) {
      return;  // its outcome is recorded once the screw is done
    }
    ScrewState& screw = level.screws[index];
    screw.done = true;
    screw.executed.reset();
    screw.clearance_at_depth.reset();
    screw.wire = {node_.flag_or("wire_asked", false), std::nullopt};
    if (node_.has("executed")) {
      screw.executed = executed_from(node_.child("executed"));
    }
    if (node_.has("clearance")) {
      screw.clearance_at_depth = clearance_from(node_.child("clearance"));
    }
    if (node_.has("wire")) {
      screw.wire.measured = wire_from(node_.child("wire"));
    }
  }

  LoggedOperation& operation_;
  OperationRecord type_;
  const JsonNode& node_;
};

Status applied(LoggedOperation& operation, const Record& record, const std::string& name) {
  const std::string where = name + ": record " + std::to_string(record.number);
  if (record.type < static_cast<std::uint16_t>(OperationRecord::kBegun) ||
      record.type > static_cast<std::uint16_t>(OperationRecord::kEnded) ||
      record.version != kOperationRecordVersion) {
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

void LoggedOperation::forget_places() {
  state.forget_places();
  for (LevelState& level : state.levels) {
    level.newest.reset();
  }
  for (std::vector<nav::Region>& of_level : strokes) {
    of_level.clear();
  }
}

void LoggedOperation::go_on() {
  ++resumed;
  done = false;
  guide_corrected = false;
  if (!identity.patient_reference) {
    forget_places();
  }
  for (LevelState& level : state.levels) {
    level.check_points.clear();
  }
  state.forget_open_rods();
}

Result<LoggedOperation> LoggedOperation::from(const std::vector<Record>& records,
                                              const std::string& name) {
  LoggedOperation operation;
  for (const Record& record : records) {
    if (const Status good = applied(operation, record, name); !good) {
      return good.error();
    }
  }
  return operation;
}

}  // namespace orthonav::engine
