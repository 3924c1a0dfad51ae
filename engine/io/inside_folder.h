#pragma once

#include <string>

#include "base/result.h"

namespace orthonav::engine {

/// The path of the file that `name` means in `folder`, for names that a file of somebody else
/// states. Refuses names that lead out of the folder (absolute, with `..`, through a symbolic link)
/// and what is there but is no plain file: a device or a pipe has no end. A link that stays inside
/// is followed. Whoever may write to the folder meanwhile can still change what the path means.
Result<std::string> path_inside(const std::string& folder, const std::string& name);

/// `text` serves as part of a file's name: one to 64 characters, no '/', no control character, no
/// '.' in front.
[[nodiscard]] bool is_part_of_a_file_name(const std::string& text);

}  // namespace orthonav::engine
