#pragma once

#include <vector>

#include "nav/registration/registration.h"

namespace orthonav::nav {

/// Why a registration by the pose search must not be relied on; none when it may.
[[nodiscard]] std::vector<RefusalReason> reasons_against(
    const Registration& registration, const PoseSearchRegistrationOptions& limits);

}  // namespace orthonav::nav
