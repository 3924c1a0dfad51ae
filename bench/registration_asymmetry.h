#pragma once

#include "nav/registration/registration.h"

namespace orthonav::bench {

/// How far the part of a vertebra that a pointer reaches is from its own best mirror image: root
/// mean square distance of its vertices, mirrored and fitted, from its surface.
[[nodiscard]] double asymmetry_m(const nav::VertebraModel& model);

}  // namespace orthonav::bench
