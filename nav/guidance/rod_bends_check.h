#pragma once

#include <span>

#include "base/result.h"
#include "nav/guidance/rod_bends.h"

namespace orthonav::nav {

// What `rod_instructions` refuses before anything is calculated: the
// first value outside its limits, in one line.

[[nodiscard]] Status check_rod_bending(const RodBending& bending);
[[nodiscard]] Status check_rod_seats(std::span<const Vec3> seats_m);

}  // namespace orthonav::nav
