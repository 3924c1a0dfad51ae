#pragma once

#include <string>

#include "base/result.h"

namespace orthonav::engine {

/// The path of the file `name` in `folder`, for names that come from files made elsewhere. Refuses
/// names that lead out of the folder (absolute, with `..`, through a symbolic link) and anything
/// that is not a regular file, since a device or a pipe has no end. A link that stays inside is
/// followed. Does not protect against changes of the folder between this check and opening the
/// file.
Result<std::string> path_inside(const std::string& folder, const std::string& name);

/// Whether `text` can be part of a file's name: 1 to 64 bytes, no '/', no control character, no '.'
/// in front.
[[nodiscard]] bool is_part_of_a_file_name(const std::string& text);

}  // namespace orthonav::engine
