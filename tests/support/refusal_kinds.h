#pragma once

#include <vector>

#include "nav/registration/registration.h"

namespace orthonav::test {

/// Why a registration was refused, without the numbers.
inline std::vector<nav::RefusalReason::Kind> kinds_of(const nav::Registration& registration) {
  std::vector<nav::RefusalReason::Kind> kinds;
  for (const nav::RefusalReason& reason : registration.reasons) {
    kinds.push_back(reason.kind);
  }
  return kinds;
}

}  // namespace orthonav::test
