#pragma once

#include <string_view>

#include "engine/session/saving.h"
#include "engine/session/status_parts.h"

namespace orthonav::engine {

/// "saved", "NOT SAVED", "NOT RECORDED" or nothing, after `separator`.
void write_saved(PartedText text, Saved saved, std::string_view separator);

}  // namespace orthonav::engine
