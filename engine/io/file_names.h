#pragma once

#include <string>

#include "base/result.h"

namespace orthonav::engine {

/// The folder of a path's file.
[[nodiscard]] std::string folder_of(const std::string& path);

/// The name of an earlier file: PATH-N, N from 1 on, before the extension.
[[nodiscard]] std::string earlier_name(const std::string& path, int number);
inline constexpr int kMaxEarlier = 1000;
/// "PATH: 1000 earlier ones lie beside it, move them away".
[[nodiscard]] Error too_many_earlier(const std::string& path);

/// "PATH: cannot be written: No space left on device"; `kNotFound` or `kIo`.
[[nodiscard]] Error file_error(const std::string& path, const std::string& doing, int error_number);

}  // namespace orthonav::engine
