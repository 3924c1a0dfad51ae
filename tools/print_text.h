#pragma once

#include <cstdio>

#include "base/printed.h"

namespace orthonav::tools {

/// To standard output, as std::printf; a number that rounds to zero has no sign.
template <class... Values>
void print_text(const char* format, const Values&... values) {
  std::fputs(printed(format, values...).c_str(), stdout);
}

}  // namespace orthonav::tools
