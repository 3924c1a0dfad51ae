#pragma once

#include <cstdint>
#include <vector>

namespace orthonav::soak {

/// Of this process, after what is free was given back to the system.
std::int64_t resident_kib();

/// KiB an operation by which memory grows: the median of the slopes between all pairs of points
/// (Theil 1950, Sen 1968), of which a few odd ones change nothing. 0 with fewer than two.
double growth_kib(const std::vector<double>& resident_kib);

}  // namespace orthonav::soak
