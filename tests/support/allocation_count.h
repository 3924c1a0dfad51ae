#pragma once

#include <cstddef>

namespace orthonav::test {

/// How often `operator new` has been called in this process, by any thread. C libraries that call
/// malloc are not counted. Link `orthonav_allocation_count`.
std::size_t allocation_count();
/// Likewise by the calling thread alone.
std::size_t allocations_of_this_thread();

/// While one exists, an allocation of more than this many bytes fails with std::bad_alloc.
class AllocationLimit {
 public:
  explicit AllocationLimit(std::size_t bytes);
  ~AllocationLimit();
  AllocationLimit(const AllocationLimit&) = delete;
  AllocationLimit& operator=(const AllocationLimit&) = delete;
};

}  // namespace orthonav::test
