#pragma once

#include <span>

#include "tools/orthonav/study/study_arguments.h"

namespace orthonav::tools {

/// The command that repeats an operation of this study. On pixels the preview shows it. In the
/// measurement model it is a study of that one operation, with the preview of the same room on
/// pixels as a comment. It is only that study, also on pixels, if the preview can't show the
/// operation: with stated navigation, a reference, steps left out, another exposure, or guidance,
/// instrument, tools or magnitudes other than the profile's.
[[nodiscard]] engine::ReplayCommand replay_of(const StudyArguments& arguments,
                                              std::span<const engine::Case> cases);

}  // namespace orthonav::tools
