#pragma once

#include <cstddef>

namespace orthonav::test {

/// Calls of operator new in this process so far.
[[nodiscard]] std::size_t allocations();

}  // namespace orthonav::test
