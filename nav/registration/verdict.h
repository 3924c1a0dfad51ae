#pragma once

#include <optional>
#include <vector>

#include "nav/registration/registration.h"

namespace orthonav::nav {

/// Why a registration by the pose search must not be relied on; empty if it may be.
[[nodiscard]] std::vector<RefusalReason> reasons_against(
    const Registration& registration, const PoseSearchRegistrationOptions& limits);

/// The same of any bone, of which nothing is known that strokes should reach or show: only whether
/// another pose explains the points too, and the error to expect.
[[nodiscard]] std::vector<RefusalReason> reasons_against_any_bone(
    const Registration& registration, const PoseSearchRegistrationOptions& limits);

/// The reason due to the error at the screws, if it is too large.
[[nodiscard]] std::optional<RefusalReason> error_at_screws(
    const Registration& registration, const PoseSearchRegistrationOptions& limits);

/// Whether only the error at the screws speaks against it, and is small enough that pressing places
/// on the bone can reduce it.
[[nodiscard]] bool is_provisional(const Registration& registration);

}  // namespace orthonav::nav
