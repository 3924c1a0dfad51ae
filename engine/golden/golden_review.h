#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/golden/golden_images.h"

namespace orthonav::engine {

/// One scene: the expected images, the current ones, and the problems.
struct GoldenVerdict {
  GoldenScene scene;
  std::optional<GoldenImages> expected;  ///< absent: there is no golden, or it can't be read
  GoldenImages actual;
  std::vector<std::string> problems;  ///< empty: alike
};

/// Draws a scene and compares it with its golden. An Error if it can't be drawn.
Result<GoldenVerdict> judge(GoldenPainter& painter, const GoldenScene& scene,
                            const std::filesystem::path& folder);

/// One self-contained page: expected, actual and difference × 16 side by side, differing scenes
/// first.
Result<std::string> review_page(const std::vector<GoldenVerdict>& verdicts,
                                const std::vector<std::string>& orphans);

}  // namespace orthonav::engine
