#pragma once

#include <span>

#include "tools/study_arguments.h"

namespace orthonav::tools {

/// The command that repeats an operation of this study. On pixels, with the room as documented, the
/// preview shows it; what the preview can't show (a profile, the measurement model, magnitudes at
/// zero) is a study of that one operation.
[[nodiscard]] engine::ReplayCommand replay_of(const StudyArguments& arguments,
                                              std::span<const engine::Case> cases);

}  // namespace orthonav::tools
