#pragma once

#include <optional>

#include "base/result.h"
#include "nav/registration/registration.h"

namespace orthonav::engine {

/// How the registration of a level went.
struct RegistrationOutcome {
  std::optional<nav::Registration> result;  ///< absent: none was found at all
  std::optional<Error> error;               ///< then: why
  /// It may be verified: it passed its limits, or what is touched to verify it can make it so.
  [[nodiscard]] bool passed() const { return result && (result->accepted || provisional); }
  bool provisional = false;  ///< and is verified by touch
};

}  // namespace orthonav::engine
