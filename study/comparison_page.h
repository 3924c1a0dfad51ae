#pragma once

#include <string>

#include "study/study_comparison.h"

namespace orthonav::engine {

/// Two studies beside each other as one HTML page: means, and the paired differences, one dot
/// per operation, with their mean and its 95 % interval.
[[nodiscard]] std::string comparison_html(const StudyComparison& comparison);

}  // namespace orthonav::engine
