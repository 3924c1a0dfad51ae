#pragma once

namespace orthonav::tools {

/// Memory limit of an operation, bytes: many times the measured use (docs/watchdogs.md).
inline constexpr unsigned long kMemoryCeiling = 8UL << 30U;

/// Reserves some memory. The first failed allocation frees it, prints one line and asks the command
/// to end, as SIGTERM does; later failures throw std::bad_alloc. Call it once, before any thread is
/// started.
void keep_memory_reserve();
/// For the first failed allocation: frees the reserve, reports it and asks the command to end.
/// False for every later one, and without a reserve. Allocates nothing.
bool free_memory_reserve();
/// Limits this process to the ceiling, so that a leak ends the command in an orderly way before the
/// machine swaps. A lower limit stays.
void limit_memory();

}  // namespace orthonav::tools
