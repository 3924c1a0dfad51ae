#pragma once

#include <string>

#include "base/result.h"

namespace orthonav::engine {

/// "operation.mp4: writing failed (No space left on device)", of a code of libav's.
[[nodiscard]] Error av_error(const std::string& path, const std::string& what, int code);

}  // namespace orthonav::engine
