#pragma once

#include <string_view>

#include "engine/session/work_watch.h"

namespace orthonav::engine {

/// "tracker": in English, for logs.
[[nodiscard]] std::string_view word_of(Part part);
/// "tracker stalled: nothing is guided".
[[nodiscard]] std::string_view stalled_text(Part part);

}  // namespace orthonav::engine
