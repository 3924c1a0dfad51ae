#pragma once

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "hal/sim/cameras/hololens2.h"
#include "hal/sim/cameras/room_renderer.h"

namespace orthonav::sim::scene {

/// A very rough vertebra: a body, and a process that points backwards. `rings` sets the number of
/// triangles: 8 · rings² or so.
inline RoomLevel vertebra(const std::string& label, double z_m, int rings) {
  RoomLevel level;
  level.label = label;
  level.spine_from_vertebra = {Mat3::identity(), {0.0, 0.0, z_m}};
  const auto add = [&](Vec3 centre, Vec3 radii) {
    const auto base = static_cast<std::uint32_t>(level.vertices_m.size());
    const int around = 2 * rings;
    for (int r = 0; r <= rings; ++r) {
      for (int a = 0; a < around; ++a) {
        const double polar = std::numbers::pi * r / rings;
        const double angle_rad = 2.0 * std::numbers::pi * a / around;
        level.vertices_m.push_back(centre + Vec3{radii.x * std::sin(polar) * std::cos(angle_rad),
                                                 radii.y * std::sin(polar) * std::sin(angle_rad),
                                                 radii.z * std::cos(polar)});
      }
    }
    for (int r = 0; r < rings; ++r) {
      for (int a = 0; a < around; ++a) {
        const auto at = [&](int ring, int column) {
          return base + static_cast<std::uint32_t>(ring * around + column % around);
        };
        level.triangles.push_back({at(r, a), at(r + 1, a), at(r + 1, a + 1)});
        level.triangles.push_back({at(r, a), at(r + 1, a + 1), at(r, a + 1)});
      }
    }
  };
  add({0.0, 0.0, 0.0}, {0.024, 0.018, 0.014});
  add({0.0, 0.045, -0.004}, {0.005, 0.022, 0.010});
  return level;
}

inline RoomTool tool(const std::string& name, ToolKind kind, int id, double size_m,
                     double tip_below_m) {
  RoomTool t;
  t.name = name;
  t.kind = kind;
  t.id = id;
  t.size_m = size_m;
  t.tip_in_marker = {{0.0, -tip_below_m, 0.0}};
  return t;
}

inline RoomDescription operating_room(int rings = 33) {
  RoomDescription room;
  for (int i = 0; i < 5; ++i) {
    room.levels.push_back(vertebra("L" + std::to_string(i + 1), 0.07 - 0.035 * i, rings));
  }
  room.operated = {"L3", "L4"};
  room.tools = {tool("pointer", ToolKind::kPointer, 3, 0.050, 0.15),
                tool("guide", ToolKind::kGuide, 5, 0.070, 0.15),
                tool("reference", ToolKind::kReference, 17, 0.040, 0.06)};
  room.phrases = {"begin guiding", "save points", "delete last", "accept result",
                  "reject level",  "go to next",  "finish rod"};
  return room;
}

/// A rig that looks from `eye` at `target`, upright.
inline Transform<Room, Rig> looking(Vec3 eye, Vec3 target) {
  const Vec3 back = (eye - target).normalized();
  const Vec3 right = Vec3{0, 1, 0}.cross(back).normalized();
  return {Mat3::from_columns(right, back.cross(right), back), eye};
}

/// A tool with its tip at a place, its shaft (the marker's y) along `up`, its tag facing the eye.
inline Transform<Room, Marker> holding(const RoomTool& t, Vec3 tip, Vec3 up, Vec3 eye) {
  const Vec3 y = up.normalized();
  const Vec3 towards = eye - tip;
  const Vec3 z = (towards - y.dot(towards) * y).normalized();
  const Mat3 rotation = Mat3::from_columns(y.cross(z), y, z);
  return {rotation, tip - rotation * t.tip_in_marker.v};
}

/// All three tools over the open wound, the pointer in the hand.
inline RoomState operating_state(const RoomDescription& room) {
  const Vec3 eye{0.30, 0.62, 0.03};
  RoomState state;
  state.room_from_rig = looking(eye, {0.0, 0.22, 0.03});
  state.room_from_spine = {Mat3::identity(), {0.0, 0.16, 0.0}};
  const std::vector<Vec3> tips = {{0.015, 0.21, 0.0}, {-0.02, 0.205, -0.06}, {0.0, 0.225, 0.15}};
  const std::vector<Vec3> shafts = {{0.25, 1.0, 0.25}, {0.1, 1.0, -0.45}, {0.1, 1.0, 0.3}};
  for (std::size_t i = 0; i < room.tools.size() && i < tips.size(); ++i) {
    state.room_from_marker.push_back(holding(room.tools[i], tips[i], shafts[i], eye));
    state.tool_present.push_back(true);
  }
  if (!room.tools.empty()) {
    state.hand = state.room_from_marker[0] * Point<Marker>{{0.0, -0.085, -0.01}};
    state.hand_axis = Vec3{0.55, 0.35, 0.65}.normalized();
  }
  return state;
}

/// Three moments of an exposure in which every tool moves a little.
inline std::vector<RoomState> exposure(const RoomState& middle, Vec3 step_m) {
  std::vector<RoomState> states(3, middle);
  for (std::size_t i = 0; i < 3; ++i) {
    for (auto& marker : states[i].room_from_marker) {
      marker = {marker.rotation(), marker.translation() + (static_cast<double>(i) - 1.0) * step_m};
    }
  }
  return states;
}

/// The right camera in the type that the renderer takes for either camera.
inline Transform<LeftCamera, Rig> as_camera(const Transform<RightCamera, Rig>& right) {
  return {right.rotation(), right.translation()};
}

}  // namespace orthonav::sim::scene
