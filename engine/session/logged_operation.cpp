#include "engine/session/logged_operation.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

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
        return operation_.go_on();
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
      rod.done = true;
      return read_rod(node_, rod);
    }
    if (rod.touched.empty()) {
      rod.touched = TouchedHeads({}, operation_.identity.patient_reference);
    }
    if (type_ == OperationRecord::kHeadDropped) {
      rod.touched.drop_last();
    } else if (const auto added =
                   rod.touched.add({{node_.vec3("in_world_m")}, node_.number("sd_m")});
               !std::holds_alternative<HeadTouch>(added)) {
      return node_.refuse("in_world_m", "is not where its head was touched before");
    }
    rod.heads = rod.touched.places();
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
        strokes.push_back(region_from(node_.child("region")));
        return;
      case kRegionDropped:
        return drop_region(strokes);
      case kRegistration:
        return apply_registration(index);
      case kRestored:
        level.accepted = level.registration && node_.flag_or("accepted", false);
        return;
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
        return touch_landmark(index);
      case kLandmarkDropped:
        if (!node_.flag_or("stays", false)) {
          level.landmark.reset();
        }
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

  void drop_region(std::vector<nav::Region>& strokes) const {
    if (strokes.empty()) {
      node_.refuse("level", "has no region to be deleted");
    } else {
      strokes.pop_back();
    }
  }

  void touch_landmark(std::size_t index) {
    LandmarkTouch touch;
    touch.first = node_.flag_or("first", false);
    touch.off_m = node_.number("off_m");
    touch.limit_m = node_.number("limit_m");
    operation_.landmark_touches[index].push_back({touch});
    if (touch.first) {
      operation_.state.levels[index].landmark = landmark_from(node_.child("landmark"));
    }
  }

  void apply_registration(std::size_t index) {
    LevelState& level = operation_.state.levels[index];
    LoggedRegistration asked;
    asked.time = time_;
    asked.level = index;
    asked.attempt = level.attempts = node_.integer("attempt");
    asked.passed = node_.flag_or("passed", false);
    asked.reason = node_.text("reason");
    level.tag_size.reset();
    if (node_.has("tag_size")) {
      const JsonNode size = node_.child("tag_size");
      level.tag_size = TagSizeWarning{size.text("tool"), size.number("fraction")};
    }
    asked.tag_size = level.tag_size;
    if (node_.has("registration")) {
      asked.result = registration_from(node_.child("registration"));
    }
    operation_.registrations.push_back(asked);
    if (!asked.passed) {
      return;
    }
    if (!asked.result) {
      return node_.refuse("registration", "is missing, though it passed");
    }
    level.forget_registration();
    level.registration = std::move(asked.result);
    level.digitization_s = node_.number("digitization_s");
    level.newest = {points_of(operation_.strokes[index]), *level.registration};
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
      const int redone = screws[i].integer("redone");
      if (redone != std::exchange(level.screws[i].redone, redone)) {
        level.screws[i].wire = {};  // it was of the wire that was taken out
      }
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
    ScrewState& screw = level.screws[index];
    if (type_ == OperationRecord::kWire) {
      screw.wire = {true, wire_from(node_.child("wire"))};
      return;
    }
    screw.done = true;
    screw.done_at = time_;
    screw.at_depth.reset();
    if (node_.has("at_depth")) {
      screw.at_depth = at_depth_from(node_.child("at_depth"));
    }
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

void LoggedOperation::go_on() {
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
