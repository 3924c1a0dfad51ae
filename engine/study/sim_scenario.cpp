#include "engine/study/sim_scenario.h"

namespace orthonav::engine {
namespace {

sim::ToolKind kind_of(nav::ToolRole role) {
  if (role == nav::ToolRole::kPointer) {
    return sim::ToolKind::kPointer;
  }
  if (role == nav::ToolRole::kGuide) {
    return sim::ToolKind::kGuide;
  }
  return sim::ToolKind::kReference;
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
    room.tools.push_back({tool.name, kind_of(tool.role), tool.marker.family, tool.marker.id,
                          tool.marker.size_m, tool.tip_in_marker, tool.axis_in_marker.v});
  }
  for (const OperatedLevel& level : operation.levels) {
    room.operated.push_back(level.label);
  }
  return room;
}

}  // namespace orthonav::engine
