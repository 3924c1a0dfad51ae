#pragma once

#include <string>
#include <vector>

namespace orthonav::soak {

/// The memory after each operation as a drawing (SVG), in MiB from 0 on: a point an operation,
/// those of the warm-up pale, and the line that `growth_kib` found through the others.
std::string memory_picture(const std::vector<double>& resident_kib, std::size_t warm_up,
                           double growth_kib);

}  // namespace orthonav::soak
