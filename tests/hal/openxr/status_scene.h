#pragma once

#include <string>
#include <vector>

#include "engine/holograms/shapes/hologram_status.h"
#include "render/scene.h"

namespace orthonav::test {

/// A triangle ahead, and a status line that says `step`.
inline render::Scene scene_that_says(const std::string& step) {
  render::Scene scene;
  render::TriangleItem& triangle = scene.triangles.emplace_back();
  triangle.label = 501;
  triangle.corners = {{{-0.2f, 0, -1}, {0.2f, 0, -1}, {0, 0.2f, -1}}};
  const std::vector<engine::ToolDot> tools = {{engine::ToolState::kMeasured}};
  engine::add_status_line(scene, step + " | stroke the vertebra", tools, 1101);
  return scene;
}

}  // namespace orthonav::test
