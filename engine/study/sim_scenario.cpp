#include "engine/study/sim_scenario.h"

#include <cmath>
#include <numbers>
#include <optional>

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

}  // namespace

sim::RoomDescription room_of(const Case& source, const Operation& operation,
                             const std::vector<nav::ToolGeometry>& tools) {
  sim::RoomDescription room;
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
  return room;
}

void tell_common_errors(const sim::ErrorModel& room, SessionOptions& session) {
  // At arm's length. The tag's known size and the estimated rotation remove most of the depth error
  // from a wrong rotation and centre; what remains is the scale, from focal length, baseline and
  // the printed size of the tags: cameras that are turned towards each other look the same.
  constexpr double kReach_m = 0.45;
  constexpr double kFocal_px = 365.0;
  constexpr double kBaseline_m = 0.1;
  const double across_m = kReach_m * room.calibration_centre_px / kFocal_px;
  const double depth_m =
      kReach_m * std::hypot(room.calibration_focal_ratio / std::numbers::sqrt2,
                            room.calibration_baseline_m / kBaseline_m, room.tag_scale);
  session.common.tip_m = room.tip_calibration_m;
  session.placed.tip_sd_m = room.tip_calibration_m;
  session.placed.axis_sd_rad = room.axis_calibration_rad;
  session.placed.play_rad = room.sleeve_play_rad;
  session.astray = {std::hypot(room.wire_bending_rad, room.hand_drilling_corrected_rad),
                    room.wire_skiving_m};
  session.common.cameras_m = std::sqrt((2.0 * across_m * across_m + depth_m * depth_m) / 3.0);
  constexpr double kSecondsAMinute = 60.0;
  session.map_drift_m_per_sqrt_s =
      std::hypot(room.map_drift_m_per_sqrt_s,
                 room.map_step_m * std::sqrt(room.map_steps_per_min / kSecondsAMinute));
}

}  // namespace orthonav::engine
