#include "tools/orthonav/shared/terminal_width.h"

#include <sys/ioctl.h>
#include <unistd.h>

namespace orthonav::tools {

std::optional<std::size_t> terminal_columns(int fd) {
  winsize size{};
  if (::isatty(fd) == 0 || ::ioctl(fd, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) {
    return std::nullopt;
  }
  return size.ws_col;
}

}  // namespace orthonav::tools
