#include "tools/orthonav/shared/memory_reserve.h"

#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <new>

#include "base/last_words.h"
#include "base/sanitizers.h"

namespace orthonav::tools {
namespace {

/// Enough to close log, recording and film.
constexpr std::size_t kReserveBytes = std::size_t{32} << 20U;

/// Global: a new-handler gets no arguments.
std::atomic<void*>& reserve() {
  static std::atomic<void*> bytes = nullptr;
  return bytes;
}

void ran_out() {
  if (!free_memory_reserve()) {
    std::set_new_handler(nullptr);
  }
}

}  // namespace

bool free_memory_reserve() {
  void* const kept = reserve().exchange(nullptr);
  if (kept == nullptr) {
    return false;
  }
  last_words("orthonav: out of memory: ending in order\n");
  ::munmap(kept, kReserveBytes);
  ::kill(::getpid(), SIGTERM);
  return true;
}

void keep_memory_reserve() {
  void* const bytes =
      ::mmap(nullptr, kReserveBytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (bytes != MAP_FAILED) {
    reserve() = bytes;
    std::set_new_handler(ran_out);
  }
}

void limit_memory() {
  if (sanitized()) {
    return;
  }
  rlimit limit{};
  if (::getrlimit(RLIMIT_DATA, &limit) == 0 && limit.rlim_cur > kMemoryCeiling) {
    limit.rlim_cur = std::min<rlim_t>(kMemoryCeiling, limit.rlim_max);
    (void)::setrlimit(RLIMIT_DATA, &limit);
  }
}

}  // namespace orthonav::tools
