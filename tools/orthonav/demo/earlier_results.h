#pragma once

#include <filesystem>

#include "base/result.h"

namespace orthonav::tools {

/// Removes files of an earlier demo, whose pictures or film could be taken for this run's. Only
/// files with names that a demo uses.
Status remove_earlier_results(const std::filesystem::path& folder);

}  // namespace orthonav::tools
