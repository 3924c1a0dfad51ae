#pragma once

#include <unistd.h>

#include <cerrno>
#include <string_view>

namespace orthonav {

/// Writes all bytes to a descriptor; the number of the system's error, or 0.
[[nodiscard]] inline int write_all(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(descriptor, bytes.data(), bytes.size());
    if (count >= 0) {
      bytes.remove_prefix(static_cast<std::size_t>(count));
    } else if (errno != EINTR) {
      return errno;
    }
  }
  return 0;
}

}  // namespace orthonav
