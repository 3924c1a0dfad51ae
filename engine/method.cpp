#include "engine/method.h"

namespace orthonav::engine {

Result<Method> method_named(const std::string& name) {
  if (name == "best")
    return Error{"--method best: not available in this version (available: paper)"};
  if (name != "paper") return Error{"--method " + name + ": unknown (available: paper)"};
  return Method{"paper",
                [](const StereoCalibration& calibration, std::vector<nav::ToolGeometry> tools,
                   const nav::TrackerOptions& options) {
                  return nav::create_paper_tracker(calibration, std::move(tools), options);
                },
                [](const nav::VertebraModel& model, std::span<const Point<World>> points_in_world) {
                  return nav::register_paper(model, points_in_world);
                }};
}

}  // namespace orthonav::engine
