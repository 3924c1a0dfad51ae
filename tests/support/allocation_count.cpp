#include "tests/support/allocation_count.h"

#include <atomic>
#include <cstdlib>
#include <limits>
#include <new>

// In a separate file, because a compiler that can inline these functions warns about them.

namespace {

constexpr std::size_t kUnlimited = std::numeric_limits<std::size_t>::max();
std::atomic<std::size_t> g_allocations{0};
std::atomic<std::size_t> g_largest{kUnlimited};
thread_local std::size_t t_allocations = 0;

void* counted(std::size_t size) noexcept {
  ++g_allocations;
  ++t_allocations;
  return size > g_largest ? nullptr : std::malloc(size > 0 ? size : 1);
}

}  // namespace

void* operator new(std::size_t size) {
  if (void* memory = counted(size)) {
    return memory;
  }
  throw std::bad_alloc();
}
void* operator new[](std::size_t size) { return operator new(size); }
// std::stable_sort allocates this way; memory from one pair of functions may be freed only by the
// same pair.
void* operator new(std::size_t size, const std::nothrow_t&) noexcept { return counted(size); }
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept { return counted(size); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }

namespace orthonav::test {

std::size_t allocation_count() { return g_allocations; }
std::size_t allocations_of_this_thread() { return t_allocations; }

AllocationLimit::AllocationLimit(std::size_t bytes) { g_largest = bytes; }
AllocationLimit::~AllocationLimit() { g_largest = kUnlimited; }

}  // namespace orthonav::test
