#pragma once

#include <string>

#include "base/result.h"
#include "engine/scan/volume.h"

namespace orthonav::engine {

/// As `load_volume`, in this process: a file on which a library gives up ends the program.
Result<Volume> read_volume(const std::string& path, const std::string& series);

}  // namespace orthonav::engine
