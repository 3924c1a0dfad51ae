#pragma once

#include <cstdint>
#include <string>

#include "base/result.h"

namespace orthonav::engine {

/// Refuses a file, plain or compressed by gzip, with fewer than this many bytes once unpacked, or
/// whose compressed stream is truncated or damaged. ITK's NIfTI reader would take missing voxels
/// for zeros.
Status check_whole(const std::string& path, std::uint64_t least_bytes);

}  // namespace orthonav::engine
