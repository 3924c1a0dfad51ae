#pragma once

#include <string>

#include "engine/session/log/logged_operation.h"

namespace orthonav::engine {

/// The report of an operation from its log, with the keys of report.json and besides what only the
/// log has: `session`, how it ended (docs/file-formats.md). What follows from the bones, which the
/// log does not hold, is absent.
[[nodiscard]] std::string session_json(const LoggedOperation& session);

/// The same as one self-contained HTML page. If the operation was cut off, the top says so and
/// when. `source` names the log. The same records give the same bytes.
[[nodiscard]] std::string session_page(const LoggedOperation& session, const std::string& source);

/// How the session ended, in one sentence: "The log has no end: its last record is of 02:45.57 on
/// the headset's clock, 64.7 s after the first."
[[nodiscard]] std::string ending_of(const LoggedOperation& session);

}  // namespace orthonav::engine
