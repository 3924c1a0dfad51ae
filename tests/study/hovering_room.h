#pragma once

#include <memory>
#include <vector>

#include "hal/sim/sim_headset.h"
#include "nav/tracking/tool.h"

namespace orthonav::engine {

inline sim::RoomDescription hovering_tools() {
  sim::RoomDescription room;
  room.tools = {{"pointer", ToolKind::kPointer, "tag36h11", 15, 0.040, {{0, -0.150, 0}}, {0, 1, 0}},
                {"guide", ToolKind::kGuide, "tag36h11", 16, 0.040, {{0, -0.150, 0}}, {0, 1, 0}}};
  return room;
}

/// A room in which only the head's pose has errors, with tools that hover; no images.
inline std::unique_ptr<sim::SimHeadset> hovering_room(double lasting) {
  sim::SimOptions options;
  options.error_model = sim::ErrorModel::perfect();
  options.error_model.head_pose_noise_m = 0.0005;
  options.error_model.head_pose_noise_rad = 0.0003;
  options.error_model.head_pose_lasting = lasting;
  options.render = false;
  return sim::SimHeadset::open(hovering_tools(), options).value();
}

inline std::vector<nav::ToolGeometry> geometry_of(const sim::SimHeadset& room) {
  std::vector<nav::ToolGeometry> tools;
  for (const sim::RoomTool& tool : room.room().tools) {
    nav::ToolGeometry geometry;
    geometry.name = tool.name;
    geometry.marker = {tool.family, tool.id, tool.size_m};
    geometry.tip_in_marker = tool.tip_in_marker;
    geometry.axis_in_marker = Direction<Marker>{tool.axis_in_marker};
    tools.push_back(geometry);
  }
  return tools;
}

}  // namespace orthonav::engine
