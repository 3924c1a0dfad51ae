#include <cstddef>

#include "tools/orthonav/shared/memory_reserve.h"

// Some C libraries use what malloc returns without checking it (libapriltag). With these functions
// in place of libc's, their first failing allocation gets the memory that was set aside, and the
// command ends in order instead of crashing. All other calls are passed to libc.
extern "C" {

void* libc_malloc(std::size_t bytes) noexcept __asm__("__libc_malloc");
void* libc_calloc(std::size_t count, std::size_t bytes) noexcept __asm__("__libc_calloc");
void* libc_realloc(void* before, std::size_t bytes) noexcept __asm__("__libc_realloc");

void* malloc(std::size_t bytes) noexcept {
  void* const given = libc_malloc(bytes);
  return given == nullptr && orthonav::tools::free_memory_reserve() ? libc_malloc(bytes) : given;
}

void* calloc(std::size_t count, std::size_t bytes) noexcept {
  void* const given = libc_calloc(count, bytes);
  return given == nullptr && orthonav::tools::free_memory_reserve() ? libc_calloc(count, bytes)
                                                                    : given;
}

void* realloc(void* before, std::size_t bytes) noexcept {
  void* const given = libc_realloc(before, bytes);
  return given == nullptr && bytes > 0 && orthonav::tools::free_memory_reserve()
             ? libc_realloc(before, bytes)
             : given;
}

}  // extern "C"
