#pragma once

#include <span>

#include "tools/study_arguments.h"

namespace orthonav::tools {

/// The command that repeats an operation of this study. On pixels the preview shows it. In the
/// measurement model it is a study of that one operation, with the preview of the same room on
/// pixels as a comment; alone, where the preview can't show the room at all (stated navigation, a
/// reference, magnitudes at zero).
[[nodiscard]] engine::ReplayCommand replay_of(const StudyArguments& arguments,
                                              std::span<const engine::Case> cases);

}  // namespace orthonav::tools
