#include "tests/support/scripted_tracker.h"

namespace orthonav::test {
namespace {

constexpr double kTip_m = 0.150;  // below the tag, along its -y

}  // namespace

ScriptedTracker::ScriptedTracker() {
  nav::ToolGeometry pointer_tool{
      "pointer", nav::ToolRole::kPointer, {"tag36h11", 3, 0.05}, {{0, -kTip_m, 0}}, {{0, 1, 0}}};
  nav::ToolGeometry guide_tool{
      "guide", nav::ToolRole::kGuide, {"tag36h11", 5, 0.07}, {{0, -kTip_m, 0}}, {{0, 1, 0}}};
  tools_ = {pointer_tool, guide_tool};
  states_.resize(2);
}

void ScriptedTracker::hang_on_reference() {
  tools_.push_back(
      {"reference", nav::ToolRole::kReference, {"tag36h11", 17, 0.04}, {{0, -0.06, 0}}});
  states_.resize(3);
  hangs_on_reference_ = true;
}

void ScriptedTracker::has_pointer_alone() {
  tools_.resize(1);
  states_.resize(1);
}

void ScriptedTracker::add_other(const nav::ToolGeometry& tool) {
  tools_.push_back(tool);
  states_.resize(tools_.size());
}

std::span<const nav::ToolState> ScriptedTracker::track(const StereoFrame& frame) {
  reference.in_sight = reference_seen;
  if (reference_seen) {
    reference.last_seen = frame.time;
  }
  // The reference, if there is one, comes before the other tool.
  const bool anchored = hangs_on_reference_;
  const std::optional<Transform<World, Marker>> poses[] = {
      pointer, guide, anchored ? reference_pose : other, other};
  const PoseStatus origins[] = {pointer_origin, guide_origin, PoseStatus::kMeasured,
                                PoseStatus::kMeasured};
  for (std::size_t i = 0; i < states_.size(); ++i) {
    states_[i].tool = i;
    states_[i].world_from_marker = {};
    states_[i].world_from_marker.time = frame.time;
    if (!poses[i]) {
      continue;
    }
    states_[i].world_from_marker.value = *poses[i];
    states_[i].world_from_marker.status = origins[i];
  }
  return states_;
}

Transform<World, Marker> guide_at(Vec3 tip, double angle_rad) {
  const Mat3 rotation = rotation_from_vector({0, 0, angle_rad});
  return {rotation, tip - rotation * Vec3{0, -kTip_m, 0}};
}

Transform<World, Marker> pointer_at(Vec3 tip) { return guide_at(tip, 0.0); }

}  // namespace orthonav::test
