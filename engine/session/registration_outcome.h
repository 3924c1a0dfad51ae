#pragma once

#include <optional>

#include "base/result.h"
#include "nav/registration/registration.h"

namespace orthonav::engine {

/// How the registration of a level went.
struct RegistrationOutcome {
  std::optional<nav::Registration> result;  ///< absent: none was found
  std::optional<Error> error;               ///< why none was found
  /// It may be verified: it passed its limits, or may still pass by what is touched to verify it.
  [[nodiscard]] bool passed() const { return result && (result->accepted || provisional); }
  bool provisional = false;  ///< may pass once verified by touch
};

}  // namespace orthonav::engine
