#pragma once

#include <memory>
#include <string>
#include <vector>

#include "nav/guidance/screw.h"
#include "nav/registration/registration.h"
#include "nav/tracking/tool_tracker.h"

// Values that one part of the module creates and another uses.
namespace orthonav::python {

/// A prepared vertebra.
struct Model {
  std::shared_ptr<const nav::VertebraModel> prepared;
};

struct RegisteredBone {
  nav::Registration registration;
  std::vector<nav::ScrewPlan> screws;
};

struct TrackedTool {
  std::string tool;
  nav::ToolState state;

  [[nodiscard]] const nav::TrackedPose& pose() const { return state.world_from_marker; }
  [[nodiscard]] bool lost() const { return pose().status == PoseStatus::kLost; }
};

/// Refuses a screw that does not belong to this bone.
void check_screw(const nav::VertebraModel& model, const nav::ScrewPlan& screw);

}  // namespace orthonav::python
