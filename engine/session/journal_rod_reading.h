#pragma once

#include <cstddef>

#include "engine/io/json_document.h"
#include "engine/session/session_record.h"

namespace orthonav::engine {

// Reads the lines of a journal about rods, for the file that reads journals. Impossible content is
// refused.

/// A number of things, not negative.
[[nodiscard]] std::size_t count_of(const JsonNode& line, const char* key);
/// The touches of a head with the one just made, or without the one just dropped. In journals from
/// before heads were touched several times, each touch was of another head.
[[nodiscard]] std::size_t touches_of(const JsonNode& line, bool touched);
/// A rod that was declared done.
[[nodiscard]] RecordedRod recorded_rod_of(const JsonNode& line);

}  // namespace orthonav::engine
