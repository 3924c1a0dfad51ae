#pragma once

#include <vector>

#include "base/result.h"
#include "engine/case/operation.h"
#include "nav/tracking/tool.h"

namespace orthonav::engine {

/// A vertebra moves by 2 mm or more relative to one that is farther away than this many levels.
inline constexpr int kFarthestReference = 2;

/// Refuses a level whose nearest patient reference is clamped more than `kFarthestReference`
/// vertebrae away, and a reference on a level that the case does not have. Levels are counted along
/// the spine if the case has them, and by height (40 mm each) where it leaves some out. A reference
/// without a stated level is not limited.
[[nodiscard]] Status check_references(const Operation& operation,
                                      const std::vector<nav::ToolGeometry>& tools);

}  // namespace orthonav::engine
