#include "study/evaluation.h"

#include <algorithm>

#include "nav/evaluation/errors.h"
#include "nav/tracking/tool_tracker.h"

namespace orthonav::engine {
namespace {

/// The bone in the room, from which its model may differ; empty where the room has none.
nav::SurfaceIndex bone_of(const sim::RoomDescription& room, std::string_view label) {
  const auto level = std::ranges::find(room.levels, label, &sim::RoomLevel::label);
  return level == room.levels.end() ? nav::SurfaceIndex(nav::TriangleMesh{})
                                    : nav::SurfaceIndex({level->vertices_m, level->triangles});
}

}  // namespace

void GroundTruthRecorder::registered(Timestamp /*time*/, const LevelState& level,
                                     const RegistrationOutcome& outcome) {
  if (outcome.passed()) {
    note(level, outcome.result->world_from_vertebra);
  }
}

void GroundTruthRecorder::accepted(Timestamp /*time*/, const LevelState& level,
                                   std::string_view /*shown*/) {
  note(level, level.registration->world_from_vertebra);
}

void GroundTruthRecorder::note(const LevelState& level,
                               const Transform<World, Vertebra>& estimated) {
  const auto room_from_vertebra =
      sim::room_from_level(headset_.room(), headset_.state(), level.plan.label);
  if (!room_from_vertebra) {
    return;
  }
  const auto world_from_vertebra = headset_.world_from_room() * *room_from_vertebra;
  std::erase_if(registrations_, [&](const TruePose& l) { return l.label == level.plan.label; });
  registrations_.push_back({level.plan.label, map_from_session() * estimated, world_from_vertebra});
}

Transform<World, World> GroundTruthRecorder::map_from_session() const {
  const nav::Anchor* anchor = session_.tracker().anchor();
  if (anchor == nullptr || !anchor->last_seen) {
    return {};
  }
  return headset_.actual_from_reported(*anchor->last_seen) * anchor->world_from_anchored;
}

void GroundTruthRecorder::head_recorded(Timestamp /*time*/, nav::Side side,
                                        const HeadTouch& touch) {
  touched_.push_back({side, touch.head,
                      headset_.world_from_room().inverse() * (map_from_session() * touch.place)});
}

void GroundTruthRecorder::head_dropped(Timestamp /*time*/, nav::Side side,
                                       const HeadTouch& /*touch*/) {
  const auto last = std::find_if(touched_.rbegin(), touched_.rend(),
                                 [&](const TouchedHead& head) { return head.side == side; });
  if (last != touched_.rend()) {
    touched_.erase(std::next(last).base());
  }
}

void GroundTruthRecorder::evaluate(OperationResult& result) const {
  for (std::size_t i = 0; i < result.state.levels.size(); ++i) {
    result.truth.levels[i] = truth_of(result.state.levels[i]);
  }
  for (std::size_t i = 0; i < result.state.rods.size(); ++i) {
    result.truth.rods[i] = truth_of(result.state.rods[i]);
  }
}

LevelTruth GroundTruthRecorder::truth_of(const LevelState& level) const {
  LevelTruth truth;
  const auto pose = std::ranges::find(registrations_, level.plan.label, &TruePose::label);
  if (pose != registrations_.end() && level.registration) {
    double sum = 0.0;
    const auto vertebra_from_world = pose->truth.inverse();
    for (const nav::ScrewPlan& screw : level.plan.screws) {
      for (const Point<Vertebra> target : {screw.entry, screw.target}) {
        const Point<Vertebra> registered = vertebra_from_world * (pose->estimated * target);
        truth.errors_m.push_back(registered - target);
        sum += truth.errors_m.back().norm();
      }
    }
    truth.tre_m = sum / (2.0 * static_cast<double>(level.plan.screws.size()));
  }
  const nav::SurfaceIndex bone = bone_of(headset_.room(), level.plan.label);
  for (std::size_t s = 0; s < level.plan.screws.size(); ++s) {
    const nav::ScrewPlan& plan = level.plan.screws[s];
    ScrewTruth& screw = truth.screws.emplace_back();
    // The last wire counts: an earlier one at the same place was taken out again.
    for (const sim::DrivenWire& wire : headset_.truth().wires) {
      if (wire.level != level.plan.label || wire.side != plan.side) {
        continue;
      }
      const nav::SurfaceIndex& surface = level.plan.model->surface();
      const nav::Axis<Vertebra> axis{wire.entry, wire.direction};
      const nav::ScrewError error = nav::screw_error(plan, axis, surface);
      screw.known = true;
      screw.angle_error_rad = error.angle_rad;
      screw.entry_error_m = error.entry_m;
      if (level.screws[s].replanned()) {
        const nav::ScrewError before =
            nav::screw_error(level.screws[s].preoperative, axis, surface);
        screw.preoperative_angle_error_rad = before.angle_rad;
        screw.preoperative_entry_error_m = before.entry_m;
      }
      screw.driven = nav::cylinder_along(axis, plan, bone);
      screw.clearance = screw.driven ? nav::least_clearance(bone, *screw.driven) : std::nullopt;
    }
  }
  return truth;
}

/// The mean of each head's touches.
std::vector<Point<sim::Room>> GroundTruthRecorder::touched_heads(nav::Side side) const {
  std::vector<Point<sim::Room>> heads;
  std::vector<double> counts;
  for (const TouchedHead& touched : touched_) {
    if (touched.side != side) {
      continue;
    }
    heads.resize(std::max(heads.size(), touched.head + 1));
    counts.resize(heads.size());
    const double count = ++counts[touched.head];
    heads[touched.head].v += (touched.position.v - heads[touched.head].v) / count;
  }
  return heads;
}

RodTruth GroundTruthRecorder::truth_of(const RodState& rod) const {
  std::vector<Vec3> true_heads;
  double sum = 0.0;
  for (const Point<sim::Room>& touched : touched_heads(rod.side)) {
    const sim::PlacedHead* nearest = nullptr;
    for (const sim::PlacedHead& head : headset_.truth().heads) {
      if (head.side != rod.side) {
        continue;
      }
      if (!nearest || (head.position - touched).norm() < (nearest->position - touched).norm()) {
        nearest = &head;
      }
    }
    if (!nearest) {
      return {};
    }
    true_heads.push_back(nearest->position.v);
    sum += (nearest->position - touched).norm();
  }
  if (true_heads.empty()) {
    return {};
  }
  RodTruth truth;
  truth.head_error_m = sum / static_cast<double>(true_heads.size());
  const auto true_rod = nav::rod_template(true_heads);
  if (true_rod && rod.rod) {
    truth.length_error_m = rod.rod->length_m - true_rod->length_m;
  }
  return truth;
}

}  // namespace orthonav::engine
