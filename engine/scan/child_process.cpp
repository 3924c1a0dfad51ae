#include "engine/scan/child_process.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>
#include <string>
#include <system_error>
#include <utility>

#include "base/sanitizers.h"

namespace orthonav::engine {
namespace {

/// Nothing that a library prints on its way out is for the user.
void print_nothing() {
  const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nowhere >= 0) {
    ::dup2(nowhere, STDOUT_FILENO);
    ::dup2(nowhere, STDERR_FILENO);
  }
}

/// Of this process; man proc(5), statm.
rlim_t address_space_bytes() {
  rlim_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE));
}

/// In the child, which never returns.
[[noreturn]] void run_child(const ChildLimits& limits, const std::function<bool(int file)>& work,
                            int file) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  for (const int signal : {SIGINT, SIGTERM, SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL}) {
    std::signal(signal, SIG_DFL);
  }
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  const auto seconds = static_cast<rlim_t>(limits.processor.count());
  const rlimit processor{seconds, seconds + 1};
  ::setrlimit(RLIMIT_CPU, &processor);
  if (!sanitized()) {
    const rlim_t bytes = address_space_bytes() + limits.memory_bytes;
    const rlimit memory{bytes, bytes};
    ::setrlimit(RLIMIT_AS, &memory);
  }
  print_nothing();
  bool done = false;
  try {
    done = work(file);
  } catch (...) {
    done = false;
  }
  ::_exit(done ? 0 : 1);
}

Error no_process() {
  return {"no process to read it in: " + std::generic_category().message(errno), ErrorCode::kIo};
}

Error refused(int status, const ChildLimits& limits) {
  if (!WIFSIGNALED(status)) {
    return Error{"its reader gave up: it is damaged, or there was no memory for it"};
  }
  switch (WTERMSIG(status)) {
    case SIGINT:
    case SIGTERM:
      return Error{"reading it was stopped"};
    case SIGXCPU:
      return Error{"its reader found no end in " + std::to_string(limits.processor.count()) +
                   " s: it is damaged"};
    case SIGKILL:
      return Error{"its reader was killed: it takes too much memory or time"};
    default:
      return Error{"its reader crashed: it is damaged, or of a kind that can't be read"};
  }
}

}  // namespace

ChildBytes::ChildBytes(const MemoryFile& file) {
  struct stat about {};
  if (::fstat(file.descriptor(), &about) == 0 && about.st_size > 0) {
    const auto size = static_cast<std::size_t>(about.st_size);
    void* const mapped = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, file.descriptor(), 0);
    if (mapped != MAP_FAILED) {
      bytes_ = static_cast<const char*>(mapped);
      size_ = size;
    }
  }
}

ChildBytes::~ChildBytes() {
  if (bytes_ != nullptr) {
    ::munmap(const_cast<char*>(bytes_), size_);
  }
}

ChildBytes::ChildBytes(ChildBytes&& other) noexcept
    : bytes_(std::exchange(other.bytes_, nullptr)), size_(std::exchange(other.size_, 0)) {}

ChildBytes& ChildBytes::operator=(ChildBytes&& other) noexcept {
  std::swap(bytes_, other.bytes_);
  std::swap(size_, other.size_);
  return *this;
}

Result<ChildBytes> bytes_from_child(const ChildLimits& limits,
                                    const std::function<bool(int file)>& work) {
  const auto file = MemoryFile::create();
  if (!file) {
    return file.error();
  }
  const pid_t child = ::fork();
  if (child == 0) {
    run_child(limits, work, file->descriptor());
  }
  if (child < 0) {
    return no_process();
  }
  int status = 0;
  while (::waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) {
      return no_process();
    }
  }
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    return refused(status, limits);
  }
  return ChildBytes(*file);
}

}  // namespace orthonav::engine
