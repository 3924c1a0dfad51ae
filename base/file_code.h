#pragma once

#include <cerrno>
#include <filesystem>
#include <system_error>

#include "base/result.h"

namespace orthonav {

/// The code of a failed call on a file, from its errno.
[[nodiscard]] inline ErrorCode file_code(int error_number) {
  return error_number == ENOENT ? ErrorCode::kNotFound : ErrorCode::kIo;
}
[[nodiscard]] inline ErrorCode file_code(const std::error_code& failure) {
  return failure == std::errc::no_such_file_or_directory ? ErrorCode::kNotFound : ErrorCode::kIo;
}
/// The code of a file that could not be opened, if the errno was not kept.
[[nodiscard]] inline ErrorCode code_of_unopened(const std::filesystem::path& path) {
  std::error_code refused;
  const bool found = std::filesystem::exists(path, refused);
  return found || refused ? ErrorCode::kIo : ErrorCode::kNotFound;
}

}  // namespace orthonav
