#include <algorithm>
#include <set>
#include <string>
#include <utility>

#include "base/printed.h"
#include "hal/sim/cameras/tag_pattern.h"
#include "hal/sim/room/room_layout.h"

namespace orthonav::sim {
namespace {

constexpr double kFarthestVertex_m = 1.0;
constexpr double kLargestTag_m = 0.5;
constexpr double kLongestTool_m = 1.0;

Status check_level(const RoomLevel& level) {
  const std::string name = "room level \"" + level.label + "\": ";
  if (level.label.empty()) {
    return Error{"room level without a label"};
  }
  if (level.triangles.empty()) {
    return Error{name + "has no triangles"};
  }
  for (const Vec3 vertex : level.vertices_m) {
    if (!vertex.is_finite() || vertex.norm() > kFarthestVertex_m) {
      return Error{name + "has a vertex farther than 1 m from its origin or not finite"};
    }
  }
  for (const auto& triangle : level.triangles) {
    for (const std::uint32_t corner : triangle) {
      if (corner >= level.vertices_m.size()) {
        return Error{name + "has a triangle with vertex " + std::to_string(corner) + " of " +
                     std::to_string(level.vertices_m.size())};
      }
    }
  }
  const auto& pose = level.spine_from_vertebra;
  if (!Transform<Spine, Vertebra>::checked(pose.rotation(), pose.translation())) {
    return Error{name + "its place in the spine is not a rigid motion"};
  }
  return {};
}

Status check_tool(const RoomTool& tool) {
  const std::string name = "room tool \"" + tool.name + "\": ";
  if (!(tool.size_m > 0.0 && tool.size_m <= kLargestTag_m)) {
    return Error{name + "tag size is " + printed("%f", tool.size_m) +
                 " m, must be more than 0 and at most 0.5"};
  }
  if (!tool.tip_in_marker.v.is_finite() || tool.tip_in_marker.v.norm() > kLongestTool_m) {
    return Error{name + "tip is farther than 1 m from the tag or not finite"};
  }
  const double length = tool.axis_in_marker.norm();
  if (!(length > 0.999 && length < 1.001)) {
    return Error{name + "axis has length " + std::to_string(length) + ", must be 1"};
  }
  const int ids = tag_count(tool.family);
  if (ids == 0) {
    return Error{name + "unknown tag family \"" + tool.family + "\"; known are " + tag_families()};
  }
  if (tool.id < 0 || tool.id >= ids) {
    return Error{name + "tag id is " + std::to_string(tool.id) + ", " + tool.family + " has 0 to " +
                 std::to_string(ids - 1)};
  }
  return {};
}

}  // namespace

Status check_room(const RoomDescription& room) {
  std::set<std::string> labels;
  for (const RoomLevel& level : room.levels) {
    if (Status status = check_level(level); !status) {
      return status;
    }
    if (!labels.insert(level.label).second) {
      return Error{"room level \"" + level.label + "\": label is given twice"};
    }
  }
  for (const std::string& label : room.operated) {
    if (!labels.contains(label)) {
      return Error{"room: operated level \"" + label + "\" does not exist"};
    }
  }
  for (const StandingScrew& screw : room.screws) {
    const double length = screw.direction.norm();
    if (!labels.contains(screw.level)) {
      return Error{"room screw in \"" + screw.level + "\": that level does not exist"};
    }
    if (!screw.entry.v.is_finite() || !(length > 0.999 && length < 1.001)) {
      return Error{"room screw in \"" + screw.level +
                   "\": its entry is not finite or its direction has no length of 1"};
    }
  }
  std::set<std::pair<std::string, int>> tags;
  for (const RoomTool& tool : room.tools) {
    if (Status status = check_tool(tool); !status) {
      return status;
    }
    if (!tags.insert({tool.family, tool.id}).second) {
      return Error{"room tool \"" + tool.name + "\": tag id " + std::to_string(tool.id) + " of " +
                   tool.family + " is given twice"};
    }
  }
  return {};
}

}  // namespace orthonav::sim
