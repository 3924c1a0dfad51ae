#pragma once

#include <string_view>

#include "engine/session/saving.h"
#include "engine/session/status_parts.h"

namespace orthonav::engine {

/// "saved", "NOT SAVED", "NOT RECORDED" or nothing.
[[nodiscard]] std::string_view text_of(Saved saved);
/// The same after `separator`.
void write_saved(PartedText text, Saved saved, std::string_view separator);

}  // namespace orthonav::engine
