#pragma once

#include <memory>

#include "render/scene.h"
#include "tools/preview/planning/plan_model.h"

namespace orthonav::preview {

/// The surface of a level as drawn in space; made once a level.
struct DrawnBone {
  std::size_t level = 0;
  std::shared_ptr<const render::MeshData> mesh;
};

/// Colour of a screw by its clearance: green from 1 mm on, amber below, red where it breaks
/// through; white where no diameter is stated.
[[nodiscard]] render::Colour colour_of(const std::optional<nav::Clearance>& clearance);

/// What is drawn over a slice: the bone's outline, both screws, the place nearest to the cortex,
/// the directions at the borders, a scale. World: the vertebra's frame. `aspect` is the pane's.
void add_slice(const PlanModel& model, Pane pane, double aspect, render::Scene& scene);
/// The eye before a slice.
[[nodiscard]] render::View view_of(const engine::SlicePlane& plane, double aspect);

/// The bone with its screws in space.
void add_space(const PlanModel& model, const DrawnBone& bone, render::Scene& scene);
[[nodiscard]] render::View view_in_space(const PlanModel& model, double aspect);

}  // namespace orthonav::preview
