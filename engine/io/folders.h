#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/result.h"

namespace orthonav::engine {

/// On success, names added to or removed from that folder survive a loss of power.
Status sync_folder(const std::string& folder);

/// Makes a folder and its missing parents, each durably. Returns the new ones, the innermost first;
/// after an Error none of them is left.
Result<std::vector<std::filesystem::path>> make_folders(const std::string& path);

/// Removes those of them that are empty.
void remove_empty(const std::vector<std::filesystem::path>& folders);

}  // namespace orthonav::engine
