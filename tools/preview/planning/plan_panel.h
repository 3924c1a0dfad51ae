#pragma once

#include <string>

#include "tools/preview/planning/plan_model.h"

namespace orthonav::preview {

/// What the panel shows besides the plan.
struct PlanFacts {
  std::string device;  ///< the device that draws
  std::string scan;    ///< its file; empty: none
};

/// The panel and the help, made with Dear ImGui during a frame of the window.
void draw_plan_panel(PlanModel& model, const PlanFacts& facts);

}  // namespace orthonav::preview
