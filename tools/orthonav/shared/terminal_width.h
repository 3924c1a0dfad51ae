#pragma once

#include <cstddef>
#include <optional>

namespace orthonav::tools {

/// Columns of a file descriptor's terminal; nothing if it is not a terminal or the width is
/// unknown.
[[nodiscard]] std::optional<std::size_t> terminal_columns(int fd);

}  // namespace orthonav::tools
