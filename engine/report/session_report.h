#pragma once

#include <string>

#include "engine/session/session_record.h"

namespace orthonav::engine {

/// What a journal tells, with the keys of report.json where they mean the same, and `session`: how
/// it ended (docs/file-formats.md). What the journal does not hold is absent.
[[nodiscard]] std::string session_json(const SessionRecord& session);

/// The same as one self-contained HTML page. A session that was cut off is said so at the top, and
/// when; what the journal does not hold is "not recorded". `source` names the journal. The same
/// record gives the same bytes.
[[nodiscard]] std::string session_page(const SessionRecord& session, const std::string& source);

/// How the session ended, in one sentence: "It was cut off: the journal has no end. Its last line
/// is of 02:45.57 on the headset's clock, 64.7 s after the first."
[[nodiscard]] std::string ending_of(const SessionRecord& session);

}  // namespace orthonav::engine
