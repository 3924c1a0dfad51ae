#pragma once

#include "hal/sim/room/room.h"

namespace orthonav::test {

/// A table with two tools hovering over it.
inline sim::RoomDescription bare_room() {
  sim::RoomDescription room;
  sim::RoomTool pointer;
  pointer.name = "pointer";
  pointer.id = 3;
  pointer.size_m = 0.05;
  pointer.tip_in_marker = {{0.0, -0.15, 0.0}};
  sim::RoomTool guide = pointer;
  guide.name = "guide";
  guide.kind = sim::ToolKind::kGuide;
  guide.id = 5;
  room.tools = {pointer, guide};
  return room;
}

}  // namespace orthonav::test
