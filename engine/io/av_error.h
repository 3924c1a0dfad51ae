#pragma once

#include <string>

#include "base/result.h"

namespace orthonav::engine {

/// "operation.mp4: writing failed (No space left on device)", from an error code of libav.
[[nodiscard]] Error av_error(const std::string& path, const std::string& what, int code);

}  // namespace orthonav::engine
