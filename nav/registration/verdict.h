#pragma once

#include <optional>
#include <vector>

#include "nav/registration/registration.h"

namespace orthonav::nav {

/// Why a registration by the pose search must not be relied on; none when it may.
[[nodiscard]] std::vector<RefusalReason> reasons_against(
    const Registration& registration, const PoseSearchRegistrationOptions& limits);

/// The reason that the error at the screws gives, where it does.
[[nodiscard]] std::optional<RefusalReason> error_at_screws(
    const Registration& registration, const PoseSearchRegistrationOptions& limits);

/// Whether only the error at the screws speaks against it, and is not too large for places pressed
/// to the bone to tell it away.
[[nodiscard]] bool is_provisional(const Registration& registration);

}  // namespace orthonav::nav
