#pragma once

#include <cstddef>
#include <optional>

namespace orthonav::tools {

/// Columns of the terminal that a file descriptor is; nothing where it is none, or does not say.
[[nodiscard]] std::optional<std::size_t> terminal_columns(int fd);

}  // namespace orthonav::tools
