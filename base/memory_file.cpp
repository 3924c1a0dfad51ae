#include "base/memory_file.h"

#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "base/write_all.h"

namespace orthonav {
namespace {

Error no_file(int problem) {
  return {"no file in memory: " + std::generic_category().message(problem), ErrorCode::kIo};
}

}  // namespace

Result<MemoryFile> MemoryFile::create(std::string_view content) {
  const int descriptor = ::memfd_create("orthonav", MFD_CLOEXEC);
  if (descriptor < 0) {
    return no_file(errno);
  }
  MemoryFile file(descriptor);
  if (const int problem = write_all(descriptor, content); problem != 0) {
    return no_file(problem);
  }
  return file;
}

MemoryFile::MemoryFile(MemoryFile&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)) {}

MemoryFile::~MemoryFile() {
  if (descriptor_ >= 0) {
    ::close(descriptor_);
  }
}

std::string MemoryFile::path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

}  // namespace orthonav
