#include "engine/session/log/operation_log.h"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <tuple>

#include "engine/session/steps/digitizing.h"
#include "engine/session/steps/guiding.h"
#include "engine/session/steps/landmarking.h"
#include "engine/session/steps/placing.h"
#include "engine/session/steps/replanning.h"
#include "engine/session/steps/rod_templating.h"
#include "engine/session/steps/verifying.h"

namespace orthonav::engine {

namespace {

std::string log_in(const std::string& folder) {
  return (std::filesystem::path(folder) / "operation.resume").string();
}

/// Labels come from files, so bytes that are not UTF-8 must not end the log.
RecordLog::Entry entry(OperationRecord type, const LogJson& payload) {
  return {static_cast<std::uint16_t>(type), kOperationRecordVersion,
          payload.dump(-1, ' ', false, LogJson::error_handler_t::replace)};
}

LogJson begun(const OperationIdentity& identity, std::span<const LevelState> levels) {
  LogJson json = json_of(identity);
  json["plan"] = LogJson::array();
  for (const LevelState& level : levels) {
    LogJson screws = LogJson::array();
    for (const ScrewState& screw : level.screws) {
      screws.push_back(json_of(screw.preoperative));
    }
    json["plan"].push_back({{"label", level.plan.label}, {"screws", std::move(screws)}});
  }
  return json;
}

}  // namespace

OperationLog::OperationLog(Env& env, std::unique_ptr<FolderLock> lock,
                           std::unique_ptr<RecordLog> log, std::vector<std::string> levels,
                           RecordWriter::Waits waits)
    : env_(env),
      lock_(std::move(lock)),
      levels_(std::move(levels)),
      writer_(std::move(log), waits) {}

OperationLog::~OperationLog() {
  if (!stays_) {
    std::ignore = env_.remove(writer_.path());
  }
}

Result<std::unique_ptr<OperationLog>> OperationLog::begin(Env& env, const std::string& folder,
                                                          const OperationIdentity& identity,
                                                          std::span<const LevelState> levels,
                                                          RecordWriter::Waits waits,
                                                          RecordLog::Earlier earlier) {
  auto lock = env.lock(folder);
  if (!lock) {
    return lock.error();
  }
  auto log = RecordLog::create(env, log_in(folder),
                               entry(OperationRecord::kBegun, begun(identity, levels)), earlier);
  if (!log) {
    return log.error();
  }
  return std::unique_ptr<OperationLog>(
      new OperationLog(env, std::move(*lock), std::move(*log), identity.levels, waits));
}

Result<std::string> OperationLog::path_in(Env& env, const std::string& folder) {
  const auto path = newest_log(env, log_in(folder));
  if (!path) {
    return path.error();
  }
  if (!*path) {
    return Error{folder + ": holds no operation.resume", ErrorCode::kNotFound};
  }
  return **path;
}

Result<OperationLog::Found> OperationLog::find(Env& env, const std::string& folder) {
  auto lock = env.lock(folder);
  if (!lock) {
    return lock.error();
  }
  const auto path = path_in(env, folder);
  if (!path && path.error().code == ErrorCode::kNotFound) {
    return Error{path.error().message + ", there is no operation to resume", ErrorCode::kNotFound};
  }
  if (!path) {
    return path.error();
  }
  auto operation = LoggedOperation::read(env, *path);
  if (!operation) {
    return operation.error();
  }
  return Found{std::move(*operation), *path, std::move(*lock)};
}

std::unique_ptr<OperationLog> OperationLog::reopen(Env& env, Found found, RecordWriter::Waits waits,
                                                   std::int64_t epoch_100ns) {
  auto reopened = RecordLog::reopen(env, found.path);
  std::unique_ptr<RecordLog> records =
      reopened ? std::move(reopened->log)
               : RecordLog::closed(found.path, found.operation.records, reopened.error());
  std::unique_ptr<OperationLog> log(new OperationLog(env, std::move(found.lock), std::move(records),
                                                     found.operation.identity.levels, waits));
  log->note(OperationRecord::kResumed,
            {{"dropped_bytes", found.operation.dropped_bytes}, {"epoch_100ns", epoch_100ns}});
  return log;
}

Status OperationLog::finish(bool done, const std::string& reason,
                            std::optional<Timestamp> last_pair) {
  LogJson json = last_pair ? json_at(*last_pair) : LogJson::object();
  json["done"] = done;
  json["reason"] = reason;
  note(OperationRecord::kEnded, json);
  return writer_.finish();
}

Saved OperationLog::saved(Timestamp now, Duration lately) const {
  if (writer_.failed()) {
    return Saved::kNotSaved;
  }
  const bool something = told_ > 0 && now - told_at_ <= lately;
  return something && writer_.durable() >= told_ ? Saved::kSaved : Saved::kNothingNew;
}

LogJson OperationLog::about(Timestamp time, const LevelState& level) const {
  LogJson json = json_at(time);
  const auto index = std::find(levels_.begin(), levels_.end(), level.plan.label) - levels_.begin();
  json["level"] = index;
  json["label"] = level.plan.label;
  return json;
}

void OperationLog::add(OperationRecord type, Timestamp time, const LogJson& payload) {
  told_at_ = time;
  stays_ = true;
  told_ = writer_.add(entry(type, payload));
}

void OperationLog::note(OperationRecord type, const LogJson& payload) {
  stays_ = true;
  writer_.add(entry(type, payload));
}

void OperationLog::happened(Timestamp time, Step from, Event event, Cell answer) {
  LogJson json = json_at(time);
  json["step"] = name_of(from);
  json["event"] = name_of(event);
  json["action"] = name_of(answer.action);
  json["next"] = name_of(answer.next);
  note(OperationRecord::kEvent, json);
}

void OperationLog::asked_from_outside(const Request& request) {
  LogJson json = json_at(request.time);
  json["from"] = request.from;
  json["asked"] = request.text;
  note(OperationRecord::kAsked, json);
}

void OperationLog::not_understood(const Phrase& phrase) {
  LogJson json = json_at(phrase.time);
  json["phrase"] = phrase.text;
  json["confidence"] = phrase.confidence;
  note(OperationRecord::kNotUnderstood, json);
}

void OperationLog::registration_restored(Timestamp time, const LevelState& level) {
  LogJson json = about(time, level);
  json["accepted"] = level.accepted;
  note(OperationRecord::kRestored, json);
}

void OperationLog::calibration_found(Timestamp time, const CalibrationInUse& found) {
  LogJson json = json_at(time);
  json["found"] = json_of(found);
  note(OperationRecord::kCalibration, json);
}

void OperationLog::places_forgotten(Timestamp time) {
  add(OperationRecord::kPlacesForgotten, time, json_at(time));
}

void OperationLog::references_placed(Timestamp time, std::span<const nav::ReferencePlace> places) {
  LogJson json = json_at(time);
  json["places"] = LogJson::array();
  for (const nav::ReferencePlace& place : places) {
    json["places"].push_back(json_of(place));
  }
  add(OperationRecord::kReferences, time, json);
}

// What the steps tell; what each record holds is in its step's file.

void OperationLog::region_saved(Timestamp time, const LevelState& level,
                                const nav::Region& region) {
  LogJson json = about(time, level);
  log_region(json, region);
  add(OperationRecord::kRegion, time, json);
}

void OperationLog::region_dropped(Timestamp time, const LevelState& level) {
  add(OperationRecord::kRegionDropped, time, about(time, level));
}

void OperationLog::registered(Timestamp time, const LevelState& level,
                              const RegistrationOutcome& outcome) {
  LogJson json = about(time, level);
  log_registration(json, level, outcome);
  add(OperationRecord::kRegistration, time, json);
}

void OperationLog::level_cleared(Timestamp time, const LevelState& level) {
  add(OperationRecord::kLevelCleared, time, about(time, level));
}

void OperationLog::check_point_recorded(Timestamp time, const LevelState& level) {
  LogJson json = about(time, level);
  log_check_point(json, level);
  add(OperationRecord::kCheckPoint, time, json);
}

void OperationLog::check_point_dropped(Timestamp time, const LevelState& level) {
  add(OperationRecord::kCheckPointDropped, time, about(time, level));
}

void OperationLog::accepted(Timestamp time, const LevelState& level, std::string_view shown) {
  LogJson json = about(time, level);
  log_acceptance(json, level, shown);
  add(OperationRecord::kAccepted, time, json);
}

void OperationLog::acceptance_withdrawn(Timestamp time, const LevelState& level) {
  add(OperationRecord::kAcceptanceWithdrawn, time, about(time, level));
}

void OperationLog::landmark_touched(Timestamp time, const LevelState& level,
                                    const LandmarkTouch& touch) {
  LogJson json = about(time, level);
  log_landmark_touch(json, level, touch);
  add(OperationRecord::kLandmark, time, json);
}

void OperationLog::landmark_dropped(Timestamp time, const LevelState& level) {
  LogJson json = about(time, level);
  log_landmark_dropped(json, level);
  add(OperationRecord::kLandmarkDropped, time, json);
}

void OperationLog::tips_compared(Timestamp time, const TipDifference& difference) {
  LogJson json = json_at(time);
  log_tips(json, difference);
  add(OperationRecord::kTips, time, json);
}

void OperationLog::axis_compared(Timestamp time, const AxisDifference& difference) {
  LogJson json = json_at(time);
  log_axis(json, difference);
  add(OperationRecord::kAxis, time, json);
}

void OperationLog::wire_measured(Timestamp time, const LevelState& level, std::size_t screw,
                                 const PlacedWire& wire) {
  LogJson json = about(time, level);
  log_wire(json, screw, wire);
  add(OperationRecord::kWire, time, json);
}

void OperationLog::screw_redone(Timestamp time, const LevelState& level, std::size_t /*screw*/,
                                const nav::OtherEntry& /*entry*/) {
  LogJson json = about(time, level);
  log_plan(json, level, "redone");
  add(OperationRecord::kPlan, time, json);
}

void OperationLog::replanned(Timestamp time, const LevelState& level, const Replan& asked,
                             const ScrewReplanned& /*done*/) {
  LogJson json = about(time, level);
  log_plan(json, level, text_of(asked));
  add(OperationRecord::kPlan, time, json);
}

void OperationLog::screw_done(Timestamp time, const LevelState& level, std::size_t screw,
                              const ToolGuidance* at_depth) {
  LogJson json = about(time, level);
  log_screw(json, level, screw, at_depth);
  add(OperationRecord::kScrew, time, json);
}

void OperationLog::head_recorded(Timestamp time, nav::Side side, const HeadTouch& touch) {
  LogJson json = json_at(time);
  log_head(json, side, touch);
  add(OperationRecord::kHead, time, json);
}

void OperationLog::head_dropped(Timestamp time, nav::Side side, const HeadTouch& touch) {
  LogJson json = json_at(time);
  log_head_dropped(json, side, touch);
  add(OperationRecord::kHeadDropped, time, json);
}

void OperationLog::rod_done(Timestamp time, const RodState& rod) {
  LogJson json = json_at(time);
  log_rod(json, rod);
  add(OperationRecord::kRod, time, json);
}

}  // namespace orthonav::engine
