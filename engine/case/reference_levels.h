#pragma once

#include <vector>

#include "base/result.h"
#include "engine/case/operation.h"
#include "nav/tracking/tool.h"

namespace orthonav::engine {

/// A vertebra moves against one that is farther away than this by 2 mm and more.
inline constexpr int kFarthestReference = 2;

/// Refuses a level whose nearest patient reference is clamped more than `kFarthestReference`
/// vertebrae away, and a reference on a level that the case does not have. Levels are counted along
/// the spine as far as the case has them, and by height where it leaves some out (40 mm each). A
/// reference that says no level limits nothing.
[[nodiscard]] Status check_references(const Operation& operation,
                                      const std::vector<nav::ToolGeometry>& tools);

}  // namespace orthonav::engine
