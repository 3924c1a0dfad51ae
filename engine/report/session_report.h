#pragma once

#include <string>

#include "engine/session/session_record.h"

namespace orthonav::engine {

/// The content of a journal, with the keys of report.json for the same values, and `session`: how
/// it ended (docs/file-formats.md). Values that the journal does not hold are absent.
[[nodiscard]] std::string session_json(const SessionRecord& session);

/// The same as one self-contained HTML page. If the session was cut off, the top says so and when;
/// values that the journal does not hold are "not recorded". `source` names the journal. The same
/// record gives the same bytes.
[[nodiscard]] std::string session_page(const SessionRecord& session, const std::string& source);

/// How the session ended, in one sentence: "It was cut off: the journal has no end. Its last line
/// is of 02:45.57 on the headset's clock, 64.7 s after the first."
[[nodiscard]] std::string ending_of(const SessionRecord& session);

}  // namespace orthonav::engine
