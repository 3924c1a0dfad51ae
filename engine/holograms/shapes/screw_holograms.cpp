#include "engine/holograms/shapes/screw_holograms.h"

#include <algorithm>

#include "engine/holograms/shapes/hologram_label.h"
#include "engine/holograms/shapes/render_values.h"
#include "engine/session/placed_wire.h"

namespace orthonav::engine {
namespace {

Viewer viewer_of(const Transform<World, Rig>& head) {
  return {to_float3(head.translation()), to_float3(head.rotation().column(1))};
}

}  // namespace

Point<World> site_of(const PlacedLevel& at) {
  Vec3 sum{};
  for (const nav::ScrewPlan& screw : at.level->plan.screws) {
    sum += screw.entry.v;
  }
  const Point<Vertebra> middle{sum / static_cast<double>(at.level->plan.screws.size())};
  return at.world_from_vertebra * middle;
}

TrajectoryLine trajectory_of(const PlacedScrew& screw) {
  const auto& world_from_vertebra = screw.at.world_from_vertebra;
  const nav::ScrewPlan& plan = screw.plan();
  const Vec3 out = (plan.entry - plan.target).normalized();
  return {world_from_vertebra * (plan.entry + out * static_cast<double>(kTrajectoryOutside_m)),
          world_from_vertebra * plan.entry, world_from_vertebra * plan.target};
}

TrajectoryLine line_of(const PlacedWire& wire, const PlacedScrew& screw) {
  const auto& world_from_vertebra = screw.at.world_from_vertebra;
  const nav::Axis<Vertebra>& line = wire.axis.line;
  const double length_m = (screw.plan().target - screw.plan().entry).norm();
  return {world_from_vertebra *
              (line.point - static_cast<double>(kTrajectoryOutside_m) * line.direction),
          world_from_vertebra * line.point,
          world_from_vertebra * (line.point + length_m * line.direction)};
}

void add_wire(render::Scene& scene, const PlacedScrew& screw, const PlacedWire& wire,
              std::string& text) {
  const TrajectoryLine line = line_of(wire, screw);
  text.clear();
  append_wire(text, wire);
  add_placed_wire(scene, to_float3(line.outside.v), to_float3(line.target.v), text, wire.within(),
                  label_of(HologramKind::kTrajectory, 2));
}

CrossNumbers cross_numbers_of(const Visibility& visible) {
  CrossNumbers numbers;
  if (visible.measurement == nullptr || visible.sizes == nullptr) {
    return numbers;
  }
  numbers.sizes = *visible.sizes;
  if (visible.depth != nullptr) {
    numbers.depth = *visible.depth;
  }
  numbers.grade = visible.verdict.grade;
  numbers.worst = visible.verdict.worst;
  const nav::ScrewGuidance& tool = *visible.measurement;
  const double way = tool.depth_m / (tool.depth_m + tool.to_target_m);
  numbers.way = static_cast<float>(std::clamp(way, 0.0, 1.0));
  numbers.drilling = visible.drill.phase == nav::DrillPhase::kDrilling;
  return numbers;
}

TargetCross cross_of(const PlacedScrew& screw, const Visibility& all) {
  const VisibleCross& visible = *all.cross;
  const TrajectoryLine line = trajectory_of(screw);
  TargetCross cross;
  const Point<World> site = site_of(screw.at);
  const auto& world_from_vertebra = screw.at.world_from_vertebra;
  cross.site =
      to_float3((visible.aside ? site + (world_from_vertebra * *visible.aside).v : site).v);
  cross.outward = to_float3((line.entry - line.target).normalized());
  cross.viewer = viewer_of(visible.world_from_head);
  cross.side = visible.side;
  cross.lost = visible.lost;
  if (visible.dots) {
    cross.reading =
        CrossReading{to_float3(visible.dots->tip_offset_m), to_float3(visible.dots->top_offset_m),
                     all.verdict.grade, all.verdict.worst};
  }
  return cross;
}

LabelSide clear_side_of(const PlacedScrew& screw, const Transform<World, Rig>& head,
                        LabelSide until_now) {
  const TrajectoryLine line = trajectory_of(screw);
  return clear_side(to_float3(site_of(screw.at).v),
                    to_float3((line.entry - line.target).normalized()), viewer_of(head), until_now);
}

VirtualTwin twin_of(const PlacedScrew& screw) {
  const double away = screw.plan().entry.v.x > 0.0 ? -1.0 : 1.0;
  return {to_float3(site_of(screw.at).v),
          to_float3((screw.at.world_from_vertebra * Direction<Vertebra>{{away, 0.0, 0.0}}).v)};
}

}  // namespace orthonav::engine
