#pragma once

#include <cstddef>

#include "engine/io/json_document.h"
#include "engine/session/session_record.h"

namespace orthonav::engine {

// Reads the lines of a journal about rods, for the files that read journals and logs. Impossible
// content is refused.

/// A number of things, not negative.
[[nodiscard]] std::size_t count_of(const JsonNode& line, const char* key);
/// The number of heads after a line that says that one was touched, or that the last touch was
/// taken back, from the number before it. Lines from before heads were touched several times do not
/// count touches: each was of another head.
[[nodiscard]] std::size_t heads_after(const JsonNode& line, bool touched, std::size_t heads);
/// A rod that was declared done.
[[nodiscard]] RecordedRod recorded_rod_of(const JsonNode& line);

}  // namespace orthonav::engine
