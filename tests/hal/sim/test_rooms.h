#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/side.h"
#include "hal/sim/room/room.h"

namespace orthonav::sim {

/// A screw of a test's plan.
struct TestScrew {
  std::string level;
  Side side = Side::kLeft;
  Point<Vertebra> entry;
  Point<Vertebra> target;
};

struct TestCase {
  RoomDescription room;
  std::vector<TestScrew> screws;
};

/// Pointer, guide and reference as in the built-in definitions.
std::vector<RoomTool> test_tools();
/// A star-shaped closed bone with a spinous and two transverse processes, about as large as L4.
RoomLevel synthetic_level(const std::string& label, double z_in_spine_m);
/// Two such levels with four screws whose entries lie on the surface.
TestCase synthetic_case();
/// Levels of the Visible Human with their plans; nothing where the anatomy is absent.
std::optional<TestCase> visible_human_case(const std::vector<std::string>& operated);

}  // namespace orthonav::sim
