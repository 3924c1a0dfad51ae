#pragma once

#include <cstdint>
#include <vector>

namespace orthonav::soak {

/// Resident memory of this process, once the heap has given free memory back to the system.
std::int64_t resident_kib();

/// Growth of memory per operation: the median of the slopes between all pairs of points (Theil
/// 1950, Sen 1968), which a few outliers do not change. 0 with fewer than two.
double growth_kib(const std::vector<double>& resident_kib);

}  // namespace orthonav::soak
