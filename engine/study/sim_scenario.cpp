#include "engine/study/sim_scenario.h"

#include "engine/case/tool_file.h"
#include "hal/replay/replay_headset.h"

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

nav::ToolRole role_of(sim::ToolKind kind) {
  if (kind == sim::ToolKind::kPointer) {
    return nav::ToolRole::kPointer;
  }
  if (kind == sim::ToolKind::kGuide) {
    return nav::ToolRole::kGuide;
  }
  return nav::ToolRole::kReference;
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

std::vector<nav::ToolGeometry> described_tools(const sim::SimHeadset& headset) {
  std::vector<nav::ToolGeometry> tools;
  for (const sim::RoomTool& tool : headset.described_tools()) {
    tools.push_back({tool.name,
                     role_of(tool.kind),
                     {tool.family, tool.id, tool.size_m},
                     tool.tip_in_marker,
                     {tool.axis_in_marker}});
  }
  return tools;
}

Result<std::vector<nav::ToolGeometry>> tools_known_to(const Headset& headset) {
  if (const auto* room = dynamic_cast<const sim::SimHeadset*>(&headset)) {
    return described_tools(*room);
  }
  const auto* recording = dynamic_cast<const replay::ReplayHeadset*>(&headset);
  if (recording && !recording->tools_json().empty()) {
    return parse_tools(recording->tools_json(), "tools.json of the recording");
  }
  return built_in_tools();
}

}  // namespace orthonav::engine
