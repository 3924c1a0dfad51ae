#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <utility>

#include "render/renderer.h"
#include "tests/support/is_ok.h"

namespace orthonav::test {

/// A renderer that draws into images what the renderer under test draws into a swapchain.
inline std::unique_ptr<render::Renderer> software_renderer(int width_px, int height_px,
                                                           render::Blend blend,
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
