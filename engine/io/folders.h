#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/result.h"

namespace orthonav::engine {

/// On success the names that were given and taken away in that folder survive a loss of power.
Status sync_folder(const std::string& folder);

/// Makes a folder and those above it that are missing, each of them durable. Returns the new ones,
/// the innermost first; after an Error none of them is left.
Result<std::vector<std::filesystem::path>> make_folders(const std::string& path);

/// Removes those of them that are empty.
void remove_empty(const std::vector<std::filesystem::path>& folders);

}  // namespace orthonav::engine
