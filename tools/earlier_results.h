#pragma once

#include <filesystem>

#include "base/result.h"

namespace orthonav::tools {

/// Removes what an earlier demo left here: its pictures of steps or its film would pass for this
/// run's. Only files with the names that a demo gives.
Status remove_earlier_results(const std::filesystem::path& folder);

}  // namespace orthonav::tools
