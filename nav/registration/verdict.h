#pragma once

#include <string>
#include <vector>

#include "nav/registration/registration.h"

namespace orthonav::nav {

/// Why a registration by `best` must not be relied on, a sentence a reason; none when it may.
[[nodiscard]] std::vector<std::string> reasons_against(const Registration& registration,
                                                       const PoseSearchRegistrationOptions& limits);

}  // namespace orthonav::nav
