#pragma once

#include <string>

#include "base/result.h"

namespace orthonav::engine {

/// Copies the pictures of one MP4 into another without re-encoding them, starting at time zero and
/// with the index in front. For a film in fragments, whose length players know only after reading
/// all of it. An Error names the film as `name`.
Status remux_video(const std::string& from, const std::string& to, const std::string& name);

}  // namespace orthonav::engine
