#pragma once

#include <filesystem>

#include "base/result.h"

namespace orthonav::replay {

/// On success the folder's files and their names survive a loss of power. The folder's own name is
/// stored in its parent.
Status sync_all(const std::filesystem::path& folder);
/// Gives a folder its final name durably, after everything in it is durable.
Status rename_durably(const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace orthonav::replay
