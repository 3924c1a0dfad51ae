#include "hal/voice/memory_file.h"

#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

namespace orthonav::voice {

Result<MemoryFile> MemoryFile::create(std::string_view content) {
  const int descriptor = ::memfd_create("orthonav", MFD_CLOEXEC);
  if (descriptor < 0) {
    return Error{"voice: no file in memory: " + std::generic_category().message(errno),
                 ErrorCode::kIo};
  }
  MemoryFile file(descriptor);
  while (!content.empty()) {
    const ::ssize_t written = ::write(descriptor, content.data(), content.size());
    if (written <= 0) {
      return Error{"voice: no file in memory: " + std::generic_category().message(errno),
                   ErrorCode::kIo};
    }
    content.remove_prefix(static_cast<std::size_t>(written));
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

}  // namespace orthonav::voice
