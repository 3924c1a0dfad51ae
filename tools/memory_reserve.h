#pragma once

namespace orthonav::tools {

/// What an operation may have, in bytes: several times what was ever measured (docs/watchdogs.md).
inline constexpr unsigned long kMemoryCeiling = 8UL << 30U;

/// Keeps some memory for the moment when an allocation fails: then says so in one line, gives it
/// back and asks the command to end, as SIGTERM does. What is refused after that throws
/// std::bad_alloc. Call it once, before any other thread.
void keep_memory_reserve();
/// From now on this process gets no more than the ceiling, so that a leak ends in order instead of
/// making the whole machine crawl. A limit that is lower already stays.
void limit_memory();

}  // namespace orthonav::tools
