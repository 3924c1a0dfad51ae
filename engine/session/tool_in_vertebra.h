#pragma once

#include <optional>

#include "nav/guidance/screw.h"
#include "nav/registration/registration.h"
#include "nav/tracking/tool.h"
#include "nav/tracking/tool_tracker.h"

namespace orthonav::engine {

/// A tool as the bone has it.
struct ToolInVertebra {
  nav::Axis<Vertebra> axis;  ///< from the tip into the bone
  /// Of its pose relative to the bone; absent where the registration's is not known.
  std::optional<nav::PoseUncertainty> uncertainty;
};

[[nodiscard]] ToolInVertebra in_vertebra(const nav::Registration& registration,
                                         const nav::TrackedPose& pose,
                                         const nav::ToolGeometry& tool);

}  // namespace orthonav::engine
