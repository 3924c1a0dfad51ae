#pragma once

#include <cstdint>
#include <string>

#include "base/result.h"

namespace orthonav::engine {

/// Refuses a file, plain or compressed by gzip, that holds fewer than so many bytes once unpacked,
/// or whose compressed stream is cut off or damaged. ITK's NIfTI reader takes missing voxels
/// for zeros.
Status check_whole(const std::string& path, std::uint64_t least_bytes);

}  // namespace orthonav::engine
