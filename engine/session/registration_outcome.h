#pragma once

#include <optional>

#include "base/result.h"
#include "nav/registration/registration.h"

namespace orthonav::engine {

/// How the registration of a level went.
struct RegistrationOutcome {
  std::optional<nav::Registration> result;  ///< absent: none was found at all
  std::optional<Error> error;               ///< then: why
  /// Passed its limits: it counts.
  [[nodiscard]] bool passed() const { return result && result->accepted; }
};

}  // namespace orthonav::engine
