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

/// What makes that pose unsure beside the strokes and the tool's own pose, SDs along an axis.
struct ToolErrors {
  double walked_sd_m = 0.0;  ///< of World against the bone since it was last found
  /// Of what tool and strokes do not share, in place of the registration's errors of tip and
  /// cameras: those shift the bone and the tool alike. Absent: those count in full.
  std::optional<double> unshared_sd_m = {};
  double axis_sd_rad = 0.0;  ///< of its described axis, about each direction across it
};

[[nodiscard]] ToolInVertebra in_vertebra(const nav::Registration& registration,
                                         const nav::TrackedPose& pose,
                                         const nav::ToolGeometry& tool, const ToolErrors& errors);

}  // namespace orthonav::engine
