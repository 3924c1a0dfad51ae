#pragma once

#include <orthonav/base/result.h>
#include <cstdio>
#include <cstdlib>
#include <utility>

/// Returns the value, or prints the reason and ends the program.
template <class T>
T must(orthonav::Result<T> result) {
  if (!result) {
    std::fprintf(stderr, "%s\n", result.error().message.c_str());
    std::exit(2);
  }
  return std::move(result).value();
}

inline void must(const orthonav::Status& status) {
  if (!status) {
    std::fprintf(stderr, "%s\n", status.error().message.c_str());
    std::exit(2);
  }
}
