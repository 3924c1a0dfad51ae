#pragma once

#include <string>
#include <vector>

#include "base/result.h"
#include "base/vec.h"
#include "nav/tracking/tool.h"

namespace orthonav::tools {

/// The built-in tools, the pointer's tip as a ruler might tell it: 1.5 mm off.
[[nodiscard]] std::vector<nav::ToolGeometry> sample_tools();

/// Records the built-in pointer as a headset's cameras see it, ten pairs a second: its tip rests in
/// a dimple while it is leaned around for some seconds.
[[nodiscard]] Status record_pivoting(const std::string& folder);

/// The same in the accuracy test (docs/accuracy-test.md): held still in the dimple, turned there,
/// then set on these points of a board in order (its frame, metres).
[[nodiscard]] Status record_accuracy_test(const std::string& folder,
                                          const std::vector<Vec2>& points_m);

}  // namespace orthonav::tools
