#pragma once

#include <cstdio>
#include <string>

#include "base/printed.h"

namespace orthonav::tools {

/// To standard output, as std::printf; a number that rounds to zero has no sign.
template <class... Values>
void print_text(const char* format, const Values&... values) {
  std::fputs(printed(format, values...).c_str(), stdout);
}

/// One line on standard error.
inline void print_warning(const std::string& message) {
  std::fprintf(stderr, "orthonav: warning: %s\n", message.c_str());
}

}  // namespace orthonav::tools
