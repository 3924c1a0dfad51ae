#pragma once

#include <span>
#include <vector>

#include "base/result.h"
#include "render/renderer.h"

namespace orthonav::render {

// Check whether a scene can be drawn: an Error names item, value and limit in one line. Success
// allocates nothing. The content of a mesh is checked once, when it is first drawn (check_mesh).

[[nodiscard]] Status check_scene(const Scene& scene);
[[nodiscard]] Status check_views(const std::vector<View>& views);
[[nodiscard]] Status check_mesh(const MeshData& mesh);
[[nodiscard]] Status check_backgrounds(std::span<const RgbaImage* const> backgrounds,
                                       const std::vector<View>& views, int width_px, int height_px);
[[nodiscard]] Status check_options(const RendererOptions& options);

}  // namespace orthonav::render
