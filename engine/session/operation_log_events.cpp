#include <nlohmann/json.hpp>

#include "engine/session/operation_log.h"
#include "engine/session/replan_wording.h"

namespace orthonav::engine {
namespace {

LogJson about_side(Timestamp time, nav::Side side) {
  LogJson json = json_at(time);
  json["side"] = name_of(side);
  return json;
}

}  // namespace

// Touches, and the outcome of each screw.

void OperationLog::check_point_recorded(Timestamp time, const LevelState& level) {
  const nav::CheckPoint& point = level.check_points.back();
  LogJson json = about(time, level);
  json["in_world_m"] = json_of(point.place.v);
  json["distance_m"] = point.distance_m;
  json["limit_m"] = point.limit_m;
  json["within"] = point.within;
  add(OperationRecord::kCheckPoint, time, json);
}

void OperationLog::check_point_dropped(Timestamp time, const LevelState& level) {
  add(OperationRecord::kCheckPointDropped, time, about(time, level));
}

void OperationLog::landmark_touched(Timestamp time, const LevelState& level,
                                    const LandmarkTouch& touch) {
  LogJson json = about(time, level);
  json["first"] = touch.first;
  json["off_m"] = touch.off_m;
  json["limit_m"] = touch.limit_m;
  if (touch.first) {
    json["landmark"] = json_of(*level.landmark);
  }
  add(OperationRecord::kLandmark, time, json);
}

void OperationLog::landmark_dropped(Timestamp time, const LevelState& level) {
  LogJson json = about(time, level);
  json["stays"] = level.landmark.has_value();
  add(OperationRecord::kLandmarkDropped, time, json);
}

void OperationLog::tips_compared(Timestamp time, const TipDifference& difference) {
  LogJson json = json_at(time);
  json["apart_m"] = difference.apart_m.norm();
  json["by_m"] = json_of(difference.by_m);
  json["corrected"] = difference.corrected;
  add(OperationRecord::kGuide, time, json);
}

void OperationLog::axis_compared(Timestamp time, const AxisDifference& difference) {
  LogJson json = json_at(time);
  json["off_rad"] = difference.off_rad;
  json["by_rad"] = difference.by_rad;
  json["corrected"] = difference.corrected;
  add(OperationRecord::kGuide, time, json);
}

/// A wire that is kept beyond a limit is an override: the record holds both.
void OperationLog::wire_measured(Timestamp time, const LevelState& level, std::size_t screw,
                                 const PlacedWire& wire) {
  LogJson json = about(time, level);
  json["screw"] = screw;
  json["wire"] = json_of(wire);
  json["within"] = wire.within();
  add(OperationRecord::kWire, time, json);
}

void OperationLog::screw_redone(Timestamp time, const LevelState& level, std::size_t /*screw*/,
                                const nav::OtherEntry& /*entry*/) {
  add_plan(time, level, "redone");
}

void OperationLog::replanned(Timestamp time, const LevelState& level, const Replan& asked,
                             const ScrewReplanned& /*done*/) {
  add_plan(time, level, text_of(asked));
}

/// The plan of every screw, with the reason for each accepted breach.
void OperationLog::add_plan(Timestamp time, const LevelState& level, const std::string& why) {
  LogJson json = about(time, level);
  json["why"] = why;
  json["screws"] = LogJson::array();
  for (std::size_t i = 0; i < level.plan.screws.size(); ++i) {
    LogJson screw = json_of(level.plan.screws[i]);
    screw["redone"] = level.screws[i].redone;
    screw["earlier"] = LogJson::array();
    for (const nav::ScrewPlan& earlier : level.screws[i].earlier_plans) {
      screw["earlier"].push_back(json_of(earlier));
    }
    json["screws"].push_back(std::move(screw));
  }
  add(OperationRecord::kPlan, time, json);
}

void OperationLog::screw_done(Timestamp time, const LevelState& level, std::size_t screw,
                              const ToolGuidance* /*at_depth*/) {
  LogJson json = about(time, level);
  json["screw"] = screw;
  json["side"] = name_of(level.plan.screws[screw].side);
  const ScrewState& done = level.screws[screw];
  if (done.executed) {
    json["executed"] = json_of(*done.executed);
  }
  if (done.clearance_at_depth) {
    json["clearance"] = json_of(*done.clearance_at_depth);
  }
  json["wire_asked"] = done.wire.asked;
  if (done.wire.measured) {
    json["wire"] = json_of(*done.wire.measured);
  }
  add(OperationRecord::kScrew, time, json);
}

void OperationLog::head_recorded(Timestamp time, nav::Side side, const HeadTouch& touch) {
  LogJson json = about_side(time, side);
  json["head"] = touch.head;
  json["touches"] = touch.touches;
  json["in_world_m"] = json_of(touch.place.v);
  json["sd_m"] = touch.head_sd_m;
  add(OperationRecord::kHead, time, json);
}

void OperationLog::head_dropped(Timestamp time, nav::Side side, const HeadTouch& touch) {
  LogJson json = about_side(time, side);
  json["head"] = touch.head;
  json["touches"] = touch.touches - 1;
  add(OperationRecord::kHeadDropped, time, json);
}

void OperationLog::rod_done(Timestamp time, const RodState& rod) {
  LogJson json = about_side(time, rod.side);
  json["heads"] = rod.heads.size();
  if (rod.rod) {
    json["length_m"] = rod.rod->length_m;
  }
  add(OperationRecord::kRod, time, json);
}

}  // namespace orthonav::engine
