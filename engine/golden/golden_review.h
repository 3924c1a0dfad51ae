#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/golden/golden_images.h"

namespace orthonav::engine {

/// One scene as it is expected, as it is now, and what follows.
struct GoldenVerdict {
  GoldenScene scene;
  std::optional<GoldenImages> expected;  ///< absent: there is no golden, or it can't be read
  GoldenImages actual;
  std::vector<std::string> problems;  ///< empty: alike
};

/// Draws a scene and holds it against its golden. An error when it can't be drawn.
Result<GoldenVerdict> judge(GoldenPainter& painter, const GoldenScene& scene,
                            const std::filesystem::path& folder);

/// One page without any outside file: expected, actual and difference × 16 side by side, what
/// differs first.
Result<std::string> review_page(const std::vector<GoldenVerdict>& verdicts,
                                const std::vector<std::string>& orphans);

}  // namespace orthonav::engine
