#pragma once

#include <cstdint>
#include <string>

#include "base/result.h"

namespace orthonav::engine {

/// Refuses a file, plain or compressed by gzip, with fewer than this many bytes once unpacked, or
/// whose compressed stream is truncated or damaged. A reader would take missing voxels for
/// zeros.
Status check_whole(const std::string& path, std::uint64_t least_bytes);

/// Refuses a file that is too short for so many bytes of voxels, however well it is compressed: a
/// few bytes of a header may announce gigabytes.
Status check_long_enough(const std::string& path, std::uint64_t bytes);

/// Refuses a NRRD header that names other files for its voxels (`data file:`): a scan is one file,
/// and must not bring in any other of this machine.
Status check_names_no_other_file(const std::string& path);

}  // namespace orthonav::engine
