#include "base/last_words.h"

#include <poll.h>
#include <unistd.h>

namespace orthonav {

void last_words(std::string_view text) {
  constexpr int kMaxMs = 500;
  pollfd taken{STDERR_FILENO, POLLOUT, 0};
  if (::poll(&taken, 1, kMaxMs) > 0 && (taken.revents & POLLOUT) != 0) {
    (void)!::write(STDERR_FILENO, text.data(), text.size());
  }
}

}  // namespace orthonav
