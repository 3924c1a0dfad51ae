#pragma once

#include <optional>

#include "engine/io/json_document.h"
#include "engine/session/session_record.h"

namespace orthonav::engine {

// Reads the lines of a journal about screws, for the file that reads journals. Impossible content
// is refused.

[[nodiscard]] std::optional<double> optional_number(const JsonNode& line, const char* key,
                                                    double unit = 1.0);
[[nodiscard]] Side side_of(const JsonNode& line);
/// A screw that was declared done.
[[nodiscard]] RecordedScrew screw_of(const JsonNode& line, Timestamp time);
[[nodiscard]] RecordedWire wire_of(const JsonNode& line);

}  // namespace orthonav::engine
