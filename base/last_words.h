#pragma once

#include <string_view>

namespace orthonav {

/// Writes to standard error for a program that ends with it: past every stream and buffer, without
/// an allocation, and no longer than half a second where nobody reads.
void last_words(std::string_view text);

}  // namespace orthonav
