#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/holograms/hologram_status.h"
#include "render/renderer.h"
#include "tests/support/is_ok.h"

namespace orthonav::test {

/// A triangle ahead, and a status line that says `step`.
inline render::Scene scene_that_says(const std::string& step) {
  render::Scene scene;
  render::TriangleItem& triangle = scene.triangles.emplace_back();
  triangle.label = 501;
  triangle.corners = {{{-0.2f, 0, -1}, {0.2f, 0, -1}, {0, 0.2f, -1}}};
  const std::vector<engine::ToolDot> tools = {{"pointer", engine::ToolState::kMeasured}};
  engine::add_status_line(scene, step + " | stroke the vertebra", tools, 1101);
  return scene;
}

/// Draws as the renderer under test does, into images.
inline std::unique_ptr<render::Renderer> software(int width_px, int height_px, render::Blend blend,
                                                  render::Edges edges) {
  render::RendererOptions options;
  options.width_px = width_px;
  options.height_px = height_px;
  options.blend = blend;
  options.edges = edges;
  options.device = "llvmpipe";
  options.cache_folder = "";
  auto renderer = render::Renderer::create(options);
  EXPECT_TRUE(is_ok(renderer));
  return std::move(*renderer);
}

}  // namespace orthonav::test
