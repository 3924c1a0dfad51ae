#pragma once

#include <string>

#include "engine/session/session_record.h"

namespace orthonav::engine {

/// Shown where a journal has no figure.
inline constexpr const char* kNotRecorded = "<small>not recorded</small>";

/// The rods of a journal as a section of its page; empty where there are none.
[[nodiscard]] std::string session_rods(const SessionRecord& session);

}  // namespace orthonav::engine
