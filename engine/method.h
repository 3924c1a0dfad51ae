#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "nav/registration/registration.h"
#include "nav/tracking/tool_tracker.h"

namespace orthonav::engine {

using Registrar = std::function<Result<nav::Registration>(
    const nav::VertebraModel& model, std::span<const Point<World>> points_in_world)>;

/// One way of tracking and registering, under the name that reports carry.
struct Method {
  std::string name;
  std::function<Result<std::unique_ptr<nav::ToolTracker>>(const StereoCalibration& calibration,
                                                          std::vector<nav::ToolGeometry> tools,
                                                          const nav::TrackerOptions& options)>
      create_tracker;
  Registrar registrar;
};

/// `paper`: the published method (Liebmann et al. 2019). `best`: tools by the photometric pose of
/// their tags (docs/tracking.md), registration as published. Any other name is refused in one line
/// that names what there is.
Result<Method> method_named(const std::string& name);
/// Registration alone: `paper`.
Result<Registrar> registrar_named(const std::string& name);

}  // namespace orthonav::engine
