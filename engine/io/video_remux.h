#pragma once

#include <string>

#include "base/result.h"

namespace orthonav::engine {

/// Writes the pictures of one MP4 into another as they are, its index in front, from time zero on.
/// For a film in fragments, which plays wherever it is cut but whose length nobody knows before it
/// is read to its end. An Error names `name`.
Status remux_video(const std::string& from, const std::string& to, const std::string& name);

}  // namespace orthonav::engine
