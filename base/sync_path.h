#pragma once

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <string>

namespace orthonav {

/// How `sync_path` ended.
struct PathSync {
  bool opened = false;
  int error_number = 0;  ///< of opening or syncing; 0: durable
};

/// Makes a file's content, or the names in a folder, survive a loss of power. `flags` are passed to
/// open(2) in addition to those for reading.
[[nodiscard]] inline PathSync sync_path(const std::string& path, int flags = 0) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | flags);
  if (file < 0) {
    return {false, errno};
  }
  const int error_number = ::fsync(file) == 0 ? 0 : errno;
  ::close(file);
  return {true, error_number};
}

}  // namespace orthonav
