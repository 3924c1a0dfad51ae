#pragma once

#include <optional>

#include "nav/guidance/screw.h"
#include "nav/registration/registration.h"
#include "nav/tracking/tool.h"
#include "nav/tracking/tool_tracker.h"

namespace orthonav::engine {

/// A tool in the frame of the bone.
struct ToolInVertebra {
  nav::Axis<Vertebra> axis;  ///< from the tip into the bone
  /// Of its pose relative to the bone; absent if that of the registration is not known.
  std::optional<nav::PoseUncertainty> uncertainty;
};

/// Sources of uncertainty of that pose besides the strokes and the tool's own pose, SDs along an
/// axis.
struct ToolErrors {
  double drift_sd_m = 0.0;  ///< of World against the bone since it was last found
  /// SD of the errors that tool and strokes do not share. It replaces the registration's errors of
  /// tip and cameras, which shift the bone and the tool alike. Absent: those count in full.
  std::optional<double> unshared_sd_m = {};
  double axis_sd_rad = 0.0;  ///< of its described axis, about each direction across it
};

[[nodiscard]] ToolInVertebra in_vertebra(const nav::Registration& registration,
                                         const nav::TrackedPose& pose,
                                         const nav::ToolGeometry& tool, const ToolErrors& errors);

}  // namespace orthonav::engine
