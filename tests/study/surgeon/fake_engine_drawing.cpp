#include <algorithm>
#include <cmath>
#include <numbers>

#include "study/surgeon/shown_cross.h"
#include "study/surgeon/written_frame.h"
#include "tests/study/surgeon/fake_engine.h"

namespace orthonav::sim {

void FakeEngine::draw(const StereoFrame& frame) {
  const RoomState state = headset_.state();
  const double time_s = seconds(frame.time.time_since_epoch()) - 100.0;
  const bool blind = time_s >= options_.blind_from_s && time_s < options_.blind_to_s;
  ShownFrame shown;
  shown.pose_time = frame.time;
  shown.display_time = headset_.clock().now() + headset_.display_latency();
  shown.status = ShownStatus{step_, notice_, checks_, options_.enough, {}, {}};
  if (step_.step == Step::kVerify) {
    draw_vertebra(shown);
    if (options_.place_to_touch) {
      shown.holograms.push_back({.kind = HologramKind::kCheckPoint,
                                 .points_in_world = {world_from_vertebra(level_label()) *
                                                     Point<Vertebra>{*options_.place_to_touch}}});
    }
  }
  if (step_.step == Step::kGuide && !is_hidden(state)) {
    draw_screw(shown, state, blind);
  }
  headset_.wearer()->see(written(shown));
}

void FakeEngine::draw_vertebra(ShownFrame& shown) const {
  ShownHologram model{.kind = HologramKind::kVertebra};
  const auto& vertices = level_named(level_label()).vertices_m;
  for (const Vec3 d : {Vec3{0, 1, 0}, Vec3{1, 0, 0}, Vec3{-1, 0, 0}, Vec3{0, 0, 1}}) {
    const Vec3 extreme = *std::max_element(vertices.begin(), vertices.end(),
                                           [d](Vec3 a, Vec3 b) { return a.dot(d) < b.dot(d); });
    model.points_in_world.push_back(world_from_vertebra(level_label()) * Point<Vertebra>{extreme});
  }
  shown.holograms.push_back(model);
}

bool FakeEngine::is_hidden(const RoomState& state) {
  const Vec3 view = state.room_from_rig.rotation() * Vec3{0, 0, 1};
  const Vec3 level = Vec3{view.x, 0.0, view.z}.normalized();
  if (!view_at_first_) {
    view_at_first_ = level;
  }
  return angle_between_rad(level, *view_at_first_) < options_.shown_aside_rad;
}

void FakeEngine::draw_screw(ShownFrame& shown, const RoomState& state, bool blind) const {
  const TestScrew& screw = case_.screws[screw_];
  const auto from_vertebra = world_from_vertebra(screw.level);
  const Point<World> entry = from_vertebra * screw.entry;
  const Point<World> target = from_vertebra * screw.target;
  const Vec3 outwards = (entry - target).normalized();
  shown.holograms.push_back({.kind = HologramKind::kEntry,
                             .level = screw.level,
                             .side = screw.side,
                             .points_in_world = {entry}});
  shown.holograms.push_back({.kind = HologramKind::kTrajectory,
                             .points_in_world = {entry + 0.060 * outwards, entry, target}});
  if (!blind && state.tool_present[tool_of(case_.room, ToolKind::kGuide)]) {
    draw_guide(shown, entry, outwards, state);
  }
}

void FakeEngine::draw_guide(ShownFrame& shown, Point<World> entry, Vec3 outwards,
                            const RoomState& state) const {
  const std::size_t guide = tool_of(case_.room, ToolKind::kGuide);
  const auto world_from_marker = headset_.world_from_room() * state.room_from_marker[guide];
  const RoomTool& tool = case_.room.tools[guide];
  const Vec3 axis = (world_from_marker * Direction<Marker>{tool.axis_in_marker}).v;
  if ((world_from_marker * tool.tip_in_marker - entry).norm() > 0.040) {
    return;
  }
  // To a tenth of a degree, as the readout has it.
  const double angle_deg = angle_between_rad(axis, outwards) * 180.0 / std::numbers::pi;
  const double reading_rad = std::round(10.0 * angle_deg) / 10.0 * std::numbers::pi / 180.0;
  shown.holograms.push_back(
      {.kind = HologramKind::kTriangle,
       .points_in_world = {entry, entry + kCrossReach_m * axis, entry + kCrossReach_m * outwards}});
  shown.holograms.push_back({.kind = HologramKind::kAngle, .reading = reading_rad});
  const Vec3 tip = world_from_marker * tool.tip_in_marker - entry;
  const auto dot = [&](Vec3 from_entry) {
    const Vec3 offset = from_entry - outwards * from_entry.dot(outwards);
    const double held = std::min(1.0, kCrossRim_m / std::max(kCrossRim_m, offset.norm()));
    return entry + kCrossScale * held * offset;
  };
  shown.holograms.push_back(
      {.kind = HologramKind::kCross,
       .points_in_world = {entry, dot(tip), dot(tip + kCrossReach_m * axis)}});
  const double offset_m = (tip - outwards * tip.dot(outwards)).norm();
  shown.holograms.push_back(
      {.kind = HologramKind::kNumbers, .reading = std::ceil(offset_m / 1e-4) * 1e-4});
}

}  // namespace orthonav::sim
