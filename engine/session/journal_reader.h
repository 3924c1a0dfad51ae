#pragma once

#include <string>

#include "base/result.h"
#include "engine/session/session_record.h"

namespace orthonav::engine {

/// Reads a journal (session.orthonav), finished, cut off or still being written. A last line that
/// is torn is left out. Refuses, with file and line, what no journal holds: other formats and
/// versions, lines that are no JSON object or longer than 1 MiB, unknown words, numbers that are
/// not finite, times that go back by more than a minute.
Result<SessionRecord> read_journal(const std::string& path);
/// The same of its content; `name` stands for the file in messages.
Result<SessionRecord> read_journal_text(const std::string& text, const std::string& name);

}  // namespace orthonav::engine
