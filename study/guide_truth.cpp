#include "study/guide_truth.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace orthonav::engine {
namespace {

/// The last measurement before a wire pierced the bone must not be older than this.
constexpr Duration kNewest = std::chrono::milliseconds(500);

/// The shown certainty of the two offsets.
void add_shown(const nav::ScrewNumbers& shown, Vec3 apart_m, const nav::ScrewPlan& plan,
               GuidedError& error) {
  error.sure = shown.tip_cranial.sure && shown.tip_medial.sure;
  const auto directions = nav::directions_of(plan);
  if (!directions || !shown.tip_cranial.sd_tenths || !shown.tip_medial.sd_tenths) {
    return;
  }
  error.across_sds =
      std::hypot(apart_m.dot(directions->cranial) / (*shown.tip_cranial.sd_tenths * nav::kTenth_m),
                 apart_m.dot(directions->medial) / (*shown.tip_medial.sd_tenths * nav::kTenth_m));
}

GuidedError error_between(const nav::Axis<Vertebra>& truth, const nav::Axis<Vertebra>& tracked,
                          const nav::ScrewPlan& plan, const std::optional<ToolGuidance>& shown) {
  GuidedError error;
  const Vec3 apart_m = tracked.point - truth.point;
  const Vec3 along = (plan.target - plan.entry).normalized();
  error.tip_m = apart_m.norm();
  error.across_m = (apart_m - apart_m.dot(along) * along).norm();
  error.angle_rad = angle_between_rad(truth.direction, tracked.direction);
  if (shown && shown->numbers) {
    add_shown(*shown->numbers, apart_m, plan, error);
  }
  return error;
}

nav::Axis<Vertebra> axis_in(const Transform<Vertebra, Marker>& vertebra_from_marker,
                            Point<Marker> tip, Vec3 outwards) {
  return {vertebra_from_marker * tip,
          -(vertebra_from_marker * Direction<Marker>{outwards}).v.normalized()};
}

}  // namespace

void GuideTruth::stepped(const FrameHeader& frame, const Inputs& /*inputs*/,
                         const Guidance& guidance) {
  note_wires();
  if (guidance.step == Step::kGuide) {
    look(frame.time, guidance);
  } else {
    sightings_.clear();
  }
}

void GuideTruth::look(Timestamp time, const Guidance& guidance) {
  const LevelState& level = guidance.levels[guidance.level];
  const nav::ToolState& seen = session_.tool_states()[session_.guide()];
  const auto& room = headset_.room();
  const auto made = std::find_if(room.tools.begin(), room.tools.end(),
                                 [](const auto& tool) { return tool.kind == ToolKind::kGuide; });
  if (!level.registration || seen.world_from_marker.status != PoseStatus::kMeasured ||
      made == room.tools.end()) {
    return;
  }
  const sim::RoomState now = headset_.state();
  const auto room_from_vertebra = sim::room_from_level(room, now, level.plan.label);
  if (!room_from_vertebra) {
    return;
  }
  const auto& room_from_marker =
      now.room_from_marker[static_cast<std::size_t>(made - room.tools.begin())];
  const nav::ToolGeometry& believed = session_.geometry(session_.guide());
  const auto truth = axis_in(room_from_vertebra->inverse() * room_from_marker, made->tip_in_marker,
                             made->axis_in_marker);
  const auto tracked =
      axis_in(level.registration->world_from_vertebra.inverse() * seen.world_from_marker.value,
              believed.tip_in_marker, believed.axis_in_marker.v);
  sightings_.push_back(
      {time, error_between(truth, tracked, level.plan.screws[guidance.screw], guidance.tool)});
}

void GuideTruth::note_wires() {
  for (const sim::DrivenWire& wire : headset_.truth().wires) {
    if (wire.time <= newest_wire_) {
      continue;
    }
    newest_wire_ = wire.time;
    std::erase_if(pierced_,
                  [&](const Pierced& p) { return p.level == wire.level && p.side == wire.side; });
    const auto after =
        std::upper_bound(sightings_.begin(), sightings_.end(), wire.pierced,
                         [](Timestamp time, const Sighting& s) { return time < s.time; });
    if (after != sightings_.begin() && wire.pierced - std::prev(after)->time <= kNewest) {
      pierced_.push_back({wire.level, wire.side, std::prev(after)->error});
    }
  }
}

void GuideTruth::evaluate(OperationResult& result) const {
  for (std::size_t l = 0; l < result.state.levels.size(); ++l) {
    const OperatedLevel& plan = result.state.levels[l].plan;
    for (std::size_t s = 0; s < plan.screws.size(); ++s) {
      for (const Pierced& pierced : pierced_) {
        if (pierced.level == plan.label && pierced.side == plan.screws[s].side) {
          result.truth.levels[l].screws[s].guided = pierced.error;
        }
      }
    }
  }
}

}  // namespace orthonav::engine
