#pragma once

#include <cstddef>

namespace orthonav::test {

/// How often `operator new` has been called in this process, by any thread. C libraries that call
/// malloc are not counted.
std::size_t allocation_count();

}  // namespace orthonav::test
