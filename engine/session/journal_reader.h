#pragma once

#include <string>

#include "base/result.h"
#include "engine/session/session_record.h"

namespace orthonav::engine {

/// Reads a journal (session.orthonav), finished, cut off or still being written. A torn last line
/// is ignored. Refuses, with file and line, anything not valid in a journal: other formats and
/// versions, lines that are not a JSON object or longer than 1 MiB, unknown words, numbers that are
/// not finite, times that go back by more than a minute.
Result<SessionRecord> read_journal(const std::string& path);
/// Reads the content of a journal; `name` stands for the file in messages.
Result<SessionRecord> read_journal_text(const std::string& text, const std::string& name);

}  // namespace orthonav::engine
