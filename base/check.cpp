#include "base/check.h"

#include <cstdio>
#include <cstdlib>

namespace orthonav {

void check_failed(const char* what, const char* file, int line) {
  std::fprintf(stderr, "orthonav: internal error: %s does not hold (%s:%d)\n", what, file, line);
  std::abort();
}

}  // namespace orthonav
