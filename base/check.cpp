#include "base/check.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "base/last_words.h"

namespace orthonav {

void check_failed(const char* what, const char* file, int line) {
  char text[1024];
  const int length = std::snprintf(
      text, sizeof text, "orthonav: internal error: %s does not hold (%s:%d)\n", what, file, line);
  last_words({text, static_cast<std::size_t>(std::clamp(length, 0, int{sizeof text} - 1))});
  std::abort();
}

}  // namespace orthonav
