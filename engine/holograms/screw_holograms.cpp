#include "engine/holograms/screw_holograms.h"

#include <algorithm>

#include "engine/holograms/render_values.h"

namespace orthonav::engine {
namespace {

/// The middle of the level's entry points.
Point<World> site_of(const LevelState& level) {
  Vec3 sum{};
  for (const nav::ScrewPlan& screw : level.plan.screws) {
    sum += screw.entry.v;
  }
  const Point<Vertebra> middle{sum / static_cast<double>(level.plan.screws.size())};
  return level.registration->world_from_vertebra * middle;
}

Viewer viewer_of(const Transform<World, Rig>& head) {
  return {to_float3(head.translation()), to_float3(head.rotation().column(1))};
}

}  // namespace

Grade grade_of_tool(const Guidance& guidance, const Visibility& visible,
                    const VisibilityRules& rules) {
  if (visible.angle || visible.cross_dots) {
    return grade_of(guidance.tool->measured->angle_rad, rules.grades);
  }
  return std::max(grade_of(guidance.tool->shown.angle_rad, rules.grades), Grade::kFair);
}

TargetCross cross_of(const Guidance& guidance, const Visibility& visible,
                     const VisibilityRules& rules) {
  const LevelState& level = guidance.levels[guidance.level];
  const TrajectoryLine line = trajectory_of(level, guidance.screw);
  TargetCross cross;
  cross.site = to_float3(site_of(level).v);
  cross.outward = to_float3((line.entry - line.target).normalized());
  cross.viewer = viewer_of(*guidance.head);
  cross.side = visible.cross_side;
  cross.lost = visible.cross_lost;
  if (visible.cross_dots) {
    cross.reading = CrossReading{to_float3(guidance.tool->measured->tip_offset_m),
                                 to_float3(guidance.tool->measured->top_offset_m),
                                 grade_of_tool(guidance, visible, rules)};
  }
  return cross;
}

LabelSide clear_side_of(const LevelState& level, std::size_t screw,
                        const Transform<World, Rig>& head, LabelSide until_now) {
  const TrajectoryLine line = trajectory_of(level, screw);
  return clear_side(to_float3(site_of(level).v), to_float3((line.entry - line.target).normalized()),
                    viewer_of(head), until_now);
}

VirtualTwin twin_of(const LevelState& level, std::size_t screw) {
  const auto& world_from_vertebra = level.registration->world_from_vertebra;
  const double away = level.plan.screws[screw].entry.v.x > 0.0 ? -1.0 : 1.0;
  return {to_float3(site_of(level).v),
          to_float3((world_from_vertebra * Direction<Vertebra>{{away, 0.0, 0.0}}).v)};
}

}  // namespace orthonav::engine
