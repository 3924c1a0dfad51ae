// Wires on their way into the bones.
#include <algorithm>

#include "hal/sim/room/room_simulation.h"

namespace orthonav::sim {
namespace {

/// Height at which the hand holds the tool above the bone that its tip is in; the hand rests on the
/// back.
constexpr double kHandOverBone_m = 0.12;

}  // namespace

Transform<Vertebra, Marker> RoomSimulation::guide_in(std::size_t level) const {
  const RoomState& now = kept(steps_ - 1);
  return now.room_from_vertebra[level].inverse() *
         now.room_from_marker[*layout_.tool(ToolKind::kGuide)];
}

Vec3 RoomSimulation::guide_inwards(std::size_t level) const {
  const RoomTool& tool = room_.tools[*layout_.tool(ToolKind::kGuide)];
  return -(guide_in(level) * Direction<Marker>{tool.axis_in_marker}).v.normalized();
}

void RoomSimulation::drive_wire() {
  if (!layout_.tool(ToolKind::kGuide)) {
    return;
  }
  const auto& drilling = surgeon_->body().posture().drilling;
  if (!drilling) {
    if (wire_) {
      leave_wire();
    }
    return;
  }
  if (!wire_) {
    wire_ = pierce(*drilling);
  }
  wire_->follow(guide_inwards(drilling->level), *drilling);
}

AdvancingWire RoomSimulation::pierce(const Drilling& drilling) {
  constexpr double kSearch_m = 0.02;
  const RoomTool& tool = room_.tools[*layout_.tool(ToolKind::kGuide)];
  const Vec3 tip = (guide_in(drilling.level) * tool.tip_in_marker).v;
  const Vec3 straight = guide_inwards(drilling.level);
  const BoneSurface& bone = layout_.bone(drilling.level);
  const Vec3 slip = normal_vector(physics_, error_model_.wire_skiving_m);
  const Vec3 normal = bone.closest(tip).normal;
  const Vec3 slipped = tip + across_axis(slip, normal);
  const auto hit = bone.first_hit(slipped - kSearch_m * straight, straight, 2.0 * kSearch_m);
  back_against_level_m_ = back_moved_m_ - level_moved_m_[drilling.level];
  return {drilling, Point<Vertebra>{hit ? hit->point : bone.closest(slipped).point},
          kept(steps_ - 1).time};
}

void RoomSimulation::leave_wire() {
  const Drilling& driven = wire_->last();
  const auto& room_from_vertebra = layout_.room_from_vertebra(driven.level);
  const Vec3 straight = wire_->direction(guide_inwards(driven.level));
  const Vec3 bend = normal_vector(physics_, error_model_.wire_bending_rad) +
                    normal_vector(physics_, error_model_.hole_following_rad) +
                    (room_from_vertebra.inverse() * Direction<Room>{driven.unseen_rotation_rad}).v;
  const Vec3 direction =
      (rotation_from_vector(across_axis(bend, straight)) * straight).normalized();
  const std::string& label = room_.levels[driven.level].label;
  take_wire_out(label, driven.side);
  ++wires_driven_;
  truth_.wires.push_back(
      {label, driven.side, wire_->entry(), direction, kept(steps_ - 1).time, wire_->pierced()});
  const StandingScrew screw{label, driven.side, wire_->entry(), direction};
  truth_.heads.push_back({label, driven.side, room_from_vertebra * screw.head()});
  wire_.reset();
}

void RoomSimulation::take_wire_out(const std::string& label, Side side) {
  std::erase_if(truth_.wires,
                [&](const DrivenWire& w) { return w.level == label && w.side == side; });
  std::erase_if(truth_.heads,
                [&](const PlacedHead& h) { return h.level == label && h.side == side; });
}

Grip RoomSimulation::on_patient(const Posture& posture) const {
  Grip riding = posture.grip;
  riding.tip = riding.tip + level_moved_m_[posture.level] + posture.pushed_m;
  if (wire_) {
    // The bone holds the tip and the hand moves with the back: if they move differently, the tool
    // turns.
    const Vec3 apart_m = back_moved_m_ - level_moved_m_[posture.level] - back_against_level_m_;
    riding.axis = (kHandOverBone_m * riding.axis + apart_m).normalized();
  }
  return riding;
}

}  // namespace orthonav::sim
