#pragma once

#include <string>
#include <vector>

#include "base/result.h"
#include "base/vec.h"

namespace orthonav::tools {

/// Records the built-in pointer as a headset's cameras see it, ten pairs a second: its tip rests in
/// a dimple while it is leaned around for some seconds. The tip is where a hand-made pointer's
/// would be, 1.5 mm from the tool file's.
[[nodiscard]] Status record_pivoting(const std::string& folder);

/// The same in the accuracy test (docs/accuracy-test.md): held still in the dimple, turned there,
/// then set on these points of a board in order (its frame, metres).
[[nodiscard]] Status record_accuracy_test(const std::string& folder,
                                          const std::vector<Vec2>& points_m);

}  // namespace orthonav::tools
