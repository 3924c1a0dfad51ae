#include "study/sim_scenario.h"

#include <array>
#include <cmath>
#include <optional>

#include "engine/session/workflow/commands.h"

namespace orthonav::engine {
namespace {

/// None for a tool that the simulated surgeon does not use.
std::optional<sim::ToolKind> kind_of(nav::ToolRole role) {
  switch (role) {
    case nav::ToolRole::kPointer:
      return sim::ToolKind::kPointer;
    case nav::ToolRole::kGuide:
      return sim::ToolKind::kGuide;
    case nav::ToolRole::kReference:
      return sim::ToolKind::kReference;
    case nav::ToolRole::kAwl:
    case nav::ToolRole::kDrill:
    case nav::ToolRole::kTap:
    case nav::ToolRole::kScrewdriver:
    case nav::ToolRole::kWire:
      return std::nullopt;
  }
  return std::nullopt;
}

/// How far an error alone shifts a registration: SD along each axis, for each unit of the error.
struct Shift {
  double sim::ErrorModel::*magnitude;
  double m_per_unit;
};

/// Measured in operations in which all other errors are zero and sizes of tags are estimated in
/// use (docs/accuracy.md, "What shifts a registration as a whole").
constexpr std::array<Shift, 7> kOfCamerasAndTags = {{
    {&sim::ErrorModel::calibration_focal_ratio, 0.15},
    {&sim::ErrorModel::calibration_centre_px, 0.0017},
    {&sim::ErrorModel::calibration_rotation_rad, 0.11},
    {&sim::ErrorModel::calibration_baseline_m, 2.1},
    {&sim::ErrorModel::calibration_distortion_px, 0.00018},
    {&sim::ErrorModel::tag_scale, 0.043},
    {&sim::ErrorModel::tag_bow_m, 1.2},
}};
/// Of a tag's size that is taken as stated: all of it along the line of sight, at 0.45 m.
constexpr double kOfSizeAsStated_m = 0.26;
/// A pointer is held differently from stroke to stroke, so part of its tip's error averages out.
constexpr double kOfTip = 0.8;

}  // namespace

sim::RoomDescription room_of(const Case& source, const Operation& operation,
                             const std::vector<nav::ToolGeometry>& tools) {
  sim::RoomDescription room;
  const auto said = [](Event event) { return std::string(*phrase_of(event)); };
  room.phrases = {said(Event::kSayStart),  said(Event::kSaySave),   said(Event::kSayDelete),
                  said(Event::kSayAccept), said(Event::kSayReject), said(Event::kSayNext),
                  said(Event::kSayDone)};
  for (const CaseLevel& level : source.levels) {
    room.levels.push_back(
        {level.label, level.mesh.vertices_m, level.mesh.triangles, level.spine_from_vertebra});
  }
  for (const nav::ToolGeometry& tool : tools) {
    if (const auto kind = kind_of(tool.role)) {
      room.tools.push_back({tool.name, *kind, tool.marker.family, tool.marker.id,
                            tool.marker.size_m, tool.tip_in_marker, tool.axis_in_marker.v});
    }
  }
  for (const OperatedLevel& level : operation.levels) {
    room.operated.push_back(level.label);
  }
  for (const CaseLevel& level : source.levels) {
    if (!operation.rods_alone || level.screws.empty()) {
      continue;
    }
    room.operated.push_back(level.label);
    for (const nav::ScrewPlan& screw : level.screws) {
      room.screws.push_back(
          {level.label, screw.side, screw.entry, (screw.target - screw.entry).normalized()});
    }
  }
  return room;
}

sim::Exposure strokes_of(std::string_view method) {
  return method == "paper" ? sim::Exposure::kTrainedPattern : sim::Exposure::kLaminae;
}

Status check_standing_screws(const Operation& operation, const sim::RoomDescription& room) {
  if (operation.rods_alone && room.screws.empty()) {
    return Error{"case '" + operation.case_name +
                 "' has no screws, so none stands in the simulated room: name a case with a plan"};
  }
  return {};
}

KnownErrors errors_in(const sim::SimOptions& room, bool sizes_estimated) {
  const sim::ErrorModel& drawn = room.error_model;
  double cameras_m2 = 0.0;
  for (const Shift& shift : kOfCamerasAndTags) {
    const double sd_m = shift.m_per_unit * drawn.*shift.magnitude;
    cameras_m2 += sd_m * sd_m;
  }
  if (!sizes_estimated) {
    cameras_m2 += kOfSizeAsStated_m * kOfSizeAsStated_m * drawn.tag_scale * drawn.tag_scale;
  }
  constexpr double kSecondsAMinute = 60.0;
  const double drift =
      std::hypot(drawn.map_drift_m_per_sqrt_s,
                 drawn.map_step_m * std::sqrt(drawn.map_steps_per_min / kSecondsAMinute));
  const auto told = [&](double sd) {
    return ErrorSd{room.told_sd_factor * sd, ErrorSource::kRoom};
  };
  KnownErrors known;
  known.tip_m = told(kOfTip * drawn.tip_calibration_m);
  known.cameras_m = told(std::sqrt(cameras_m2));
  known.map_drift_m_per_sqrt_s = told(drift);
  return known;
}

void tell_instruments(const sim::SimOptions& room, SessionOptions& session) {
  const sim::ErrorModel& drawn = room.error_model;
  const double told = room.told_sd_factor;
  session.placed.tip_sd_m = told * drawn.tip_calibration_m;
  session.placed.axis_sd_rad = told * drawn.axis_calibration_rad;
  session.placed.play_rad = told * drawn.sleeve_play_rad;
  session.astray = {told * std::hypot(drawn.wire_bending_rad, drawn.hand_drilling_corrected_rad),
                    told * drawn.wire_skiving_m};
}

}  // namespace orthonav::engine
