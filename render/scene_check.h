#pragma once

#include <optional>
#include <string>
#include <vector>

#include "render/renderer.h"

namespace orthonav::render {

// What can't be drawn, as one line that names item, value and limit; nothing when all is well.
// The inside of a mesh is checked once, when it is first seen (problem_of_mesh).

[[nodiscard]] std::optional<std::string> problem_of_scene(const Scene& scene);
[[nodiscard]] std::optional<std::string> problem_of_views(const std::vector<View>& views);
[[nodiscard]] std::optional<std::string> problem_of_mesh(const MeshData& mesh);
[[nodiscard]] std::optional<std::string> problem_of_backgrounds(
    const std::vector<const RgbaImage*>& backgrounds, const std::vector<View>& views, int width_px,
    int height_px);
[[nodiscard]] std::optional<std::string> problem_of_options(const RendererOptions& options);

}  // namespace orthonav::render
