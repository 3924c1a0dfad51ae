#pragma once

namespace orthonav::tools {

/// Most memory for an operation, bytes: many times what was measured (docs/watchdogs.md).
inline constexpr unsigned long kMemoryCeiling = 8UL << 30U;

/// Sets some memory aside. The first allocation that fails frees it, prints one line and asks the
/// command to end, as SIGTERM does; those that fail later throw std::bad_alloc. Call it once,
/// before any thread is started.
void keep_memory_reserve();
/// For the first allocation that fails: frees what was set aside, says so and asks the command to
/// end. False for every later one, and where nothing was set aside. Allocates nothing.
bool free_memory_reserve();
/// Limits this process to the ceiling, so that a leak ends the command in order before the whole
/// machine swaps. A lower limit stays.
void limit_memory();

}  // namespace orthonav::tools
