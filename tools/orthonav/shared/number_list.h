#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "base/result.h"

namespace orthonav::tools {

/// Whole numbers and ranges of them, "3" or "0-5,17", in the order given. Refuses anything else,
/// descending ranges, a number that occurs twice, and more than `most` numbers.
Result<std::vector<int>> number_list(const std::string& text, std::size_t most);

}  // namespace orthonav::tools
