#pragma once

#include <string>
#include <vector>

#include "engine/session/log/operation_log.h"

namespace orthonav::engine {

/// Describes an operation about to be resumed, line by line, for the person who starts the program:
/// what it was, what is kept, what must be verified and what is lost.
[[nodiscard]] std::vector<std::string> resume_lines(const OperationLog::Found& found);

}  // namespace orthonav::engine
